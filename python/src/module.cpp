// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/error.h"

#include "bind.h"

#include <exception>

namespace trysquare::python {
namespace {

PyObject* error_type = nullptr;
PyObject* invalid_argument_type = nullptr;
PyObject* io_error_type = nullptr;

/// `trysquare.NAME`, which is also an exception of Python's own.
PyObject* add_exception(nb::module_& module, const char* full_name, const char* name, const char* doc, PyObject* base,
                        PyObject* own) {
  const nb::object bases = nb::steal(own == nullptr ? PyTuple_Pack(1, base) : PyTuple_Pack(2, base, own));
  PyObject* type = PyErr_NewExceptionWithDoc(full_name, doc, bases.ptr(), nullptr);
  if (type == nullptr) throw nb::python_error();
  module.attr(name) = nb::handle(type);
  return type;
}

void add_exceptions(nb::module_& module) {
  error_type = add_exception(module, "trysquare.Error", "Error", "Base of everything that trysquare raises.",
                             PyExc_Exception, nullptr);
  invalid_argument_type =
      add_exception(module, "trysquare.InvalidArgument", "InvalidArgument",
                    "An argument outside its range; the message names it, its value and the range. Also a ValueError.",
                    error_type, PyExc_ValueError);
  io_error_type = add_exception(module, "trysquare.IoError", "IoError",
                                "A file that is missing, malformed or cannot be written; the message names it and the "
                                "line or byte. Also an OSError.",
                                error_type, PyExc_OSError);
  nb::register_exception_translator([](const std::exception_ptr& thrown, void*) {
    try {
      std::rethrow_exception(thrown);
    } catch (const InvalidArgument& error) {
      PyErr_SetString(invalid_argument_type, error.what());
    } catch (const IoError& error) {
      PyErr_SetString(io_error_type, error.what());
    } catch (const Error& error) {
      PyErr_SetString(error_type, error.what());
    }
  });
}

}  // namespace
}  // namespace trysquare::python

NB_MODULE(_core, module) {
  using namespace trysquare::python;
  module.doc() =
      "The C++ library behind trysquare: takes and gives numpy arrays. Use the functions of trysquare itself.";
  module.attr("__version__") = TRYSQUARE_VERSION;
  add_exceptions(module);
  bind_settings(module);
  bind_scans(module);
  bind_io(module);
  bind_dataset(module);
  bind_metrics(module);
  bind_adjustment(module);
  bind_clusters(module);
  bind_trajectory(module);
  bind_pipeline(module);
}
