#include "errors.hpp"

#include <foam/base/error.hpp>

namespace foam::python {

namespace py = pybind11;

void add_errors(py::module_&) {
    py::register_local_exception_translator([](std::exception_ptr thrown) {
        try {
            std::rethrow_exception(thrown);
        } catch (const Error& error) {
            const py::object made =
                py::module_::import("foam.errors").attr("error_of")(to_string(error.code()), error.what());
            PyErr_SetObject(py::type::handle_of(made).ptr(), made.ptr());
        }
    });
}

} // namespace foam::python
