"""What docs/benchmarks/grasp_in_genesis.py uses of torch: tensors of one or two dimensions."""


class Tensor:
    def __init__(self, values):
        self.values = values

    def __getitem__(self, row):
        return Tensor(self.values[row])

    def tolist(self):
        return self.values

    def expand(self, rows, columns):
        assert columns == -1 and not isinstance(self.values[0], list)
        return Tensor([self.values] * rows)

    def expect(self, *shape):
        assert len(self.values) == shape[0], (len(self.values), shape)
        for row in self.values if len(shape) == 2 else []:
            assert len(row) == shape[1], (len(row), shape)


def tensor(values, *, dtype, device):
    assert dtype == "float32" and device == "device"
    return Tensor(values)
