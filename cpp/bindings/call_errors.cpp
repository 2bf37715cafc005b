// SPDX-License-Identifier: BSD-3-Clause
#include "call_errors.hpp"

#include <cstddef>
#include <string>

#include "parameters.hpp"

namespace bathyal::python {
namespace {

namespace py = pybind11;

constexpr const char* kNoInit =
    "object: expected one that was made by calling its class, got one made by __new__ alone";

/// pybind11 allocates what an object lacks when it is first used: here it must not lack anything.
void* refuse_allocation(std::size_t /*size*/) { throw py::type_error(kNoInit); }

using Dispatcher = PyObject* (*)(PyObject*, PyObject* const*, std::size_t, PyObject*);
Dispatcher dispatcher = nullptr;  ///< pybind11's, one for all functions of a module

const py::detail::function_record* record_of(PyObject* self) {
  return py::detail::function_record_ptr_from_PyObject(self);
}

/// Whether the error set is pybind11's own about a call that fits no signature.
bool is_misfit(const py::error_already_set& error, const py::detail::function_record& record) {
  const std::string text = py::str(error.value());
  if (error.matches(PyExc_TypeError)) {
    return text == kNoInit || text.starts_with(std::string(record.name) + "(): incompatible ");
  }
  return error.matches(PyExc_RuntimeError) &&
         text.starts_with("Unable to cast from non-held to held instance");
}

/// C++ ran out of memory, and says no more than that.
bool is_bad_alloc(const py::error_already_set& error) {
  return error.matches(PyExc_MemoryError) &&
         std::string(py::str(error.value())) == "std::bad_alloc";
}

PyObject* call(PyObject* self, PyObject* const* arguments, std::size_t count, PyObject* names) {
  PyObject* result = dispatcher(self, arguments, count, names);
  if (result != nullptr || PyErr_Occurred() == nullptr) return result;
  py::error_already_set error;
  const py::detail::function_record* record = record_of(self);
  if (record != nullptr && is_bad_alloc(error)) {
    const std::string text = "`" + std::string(record->name) +
                             "`: expected a task that fits into memory, got none left for it";
    PyErr_SetString(PyExc_MemoryError, text.c_str());
    return nullptr;
  }
  if (record == nullptr || !is_misfit(error, *record)) {
    error.restore();
    return nullptr;
  }
  try {
    const Misfit misfit =
        find_misfit(*record, arguments, static_cast<std::size_t>(PyVectorcall_NARGS(count)), names);
    PyErr_SetString(misfit.type, misfit.text.c_str());
  } catch (py::error_already_set&) {  // an argument whose own methods fail
    error.restore();
  }
  return nullptr;
}

void guard_function(py::handle function) {
  if (PyCFunction_Check(function.ptr()) == 0) return;
  auto* object = reinterpret_cast<PyCFunctionObject*>(function.ptr());
  if (object->m_self == nullptr || record_of(object->m_self) == nullptr) return;
  if (object->m_ml->ml_flags != (METH_FASTCALL | METH_KEYWORDS)) {
    py::pybind11_fail("call_errors.cpp expects functions as pybind11 3.1 makes them");
  }
  const auto method = reinterpret_cast<void (*)()>(object->m_ml->ml_meth);
  if (method == reinterpret_cast<void (*)()>(call)) return;
  dispatcher = reinterpret_cast<Dispatcher>(method);
  object->m_ml->ml_meth = reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(call));
}

void guard_class(py::handle type);

void guard_member(py::handle member) {
  PyObject* object = member.ptr();
  if (PyInstanceMethod_Check(object)) {
    guard_function(PyInstanceMethod_GET_FUNCTION(object));
  } else if (PyObject_TypeCheck(object, &PyStaticMethod_Type) != 0) {
    guard_function(member.attr("__func__"));
  } else if (PyObject_TypeCheck(object, &PyProperty_Type) != 0) {
    for (const char* part : {"fget", "fset"}) {
      const py::object function = member.attr(part);
      guard_member(function);
    }
  } else if (PyType_Check(object) != 0) {
    guard_class(member);
  } else {
    guard_function(member);
  }
}

void guard_class(py::handle type) {
  auto* info = py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(type.ptr()));
  if (info == nullptr) return;
  info->operator_new = refuse_allocation;
  const py::object members = type.attr("__dict__").attr("values")();
  for (const py::handle member : members) guard_member(member);
}

}  // namespace

void guard_calls(py::module_& module) {
  const py::object members = module.attr("__dict__").attr("values")();
  for (const py::handle member : members) guard_member(member);
}

}  // namespace bathyal::python
