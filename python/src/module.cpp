// foam._core: what foam/*.py stands on. Arrays come and go by the buffer protocol, so that any NumPy will do.
#include "module.hpp"
#include "robot.hpp"

#include <foam/base/error.hpp>
#include <foam/base/parallel.hpp>
#include <foam/judge/evaluate.hpp>
#include <foam/runtime/version.hpp>

#include <memory>

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

PYBIND11_MODULE(_core, module) {
    namespace py = pybind11;
    using namespace foam::python;
    add_errors(module);
    module.attr("KINDS") = numbers_of_kinds();
    add_mesh(module);
    add_search(module);
    add_stages(module);
    add_robot(module);
    add_judge(module);
    add_writing(module);
    add_runs(module);
    add_old(module);
    add_picture(module);
    add_own_stages(module);
    module.def("version", &foam::version);
    module.def("thread_count", &foam::thread_count);
    // Left to the end of the process: there is none of oneTBB to limit after its own end.
    static auto* const limit = new std::unique_ptr<foam::ThreadLimit>;
    module.def("limit_threads", [](std::size_t count) {
        limit->reset(); // of several limits the smallest counts
        *limit = std::make_unique<foam::ThreadLimit>(count);
    });
}
