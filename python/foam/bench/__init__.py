"""Experiments: measurements over meshes, robots and stages, described by a YAML file, reported as tables and plots.

    foam bench configs/experiments/spheres.yaml
    python3 -m foam.bench configs/experiments/spheres.yaml

It needs pandas, Matplotlib and PyYAML. A kind of experiment is a module of foam.bench.kinds.
"""
