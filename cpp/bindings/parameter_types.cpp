// SPDX-License-Identifier: BSD-3-Clause
#include "parameter_types.hpp"

#include <limits>

namespace bathyal::python {
namespace {

namespace py = pybind11;

enum class Kind {
  kAnything,
  kNothing,
  kWholeNumber,
  kNumber,
  kBool,
  kText,
  kPath,
  kDict,
  kSequence,
  kMapping,
  kCallable,
  kClass,
};

/// One alternative of a type.
struct Type {
  Kind kind;
  std::vector<std::string_view> items;  ///< types in the brackets of a sequence or a mapping
  std::string_view name;                ///< of a class, without its module
};

std::string_view after_last_dot(std::string_view text) {
  const std::size_t dot = text.rfind('.');
  return dot == std::string_view::npos ? text : text.substr(dot + 1);
}

Type read_type(std::string_view text) {
  const std::size_t bracket = text.find('[');
  const std::string_view name = after_last_dot(text.substr(0, bracket));
  std::vector<std::string_view> items;
  if (bracket != std::string_view::npos) {
    items = split_outside_brackets(text.substr(bracket + 1, text.size() - bracket - 2), ", ");
  }
  if (name == "None") return {Kind::kNothing, {}, name};
  if (name == "SupportsInt" || name == "int") return {Kind::kWholeNumber, {}, name};
  if (name == "SupportsFloat" || name == "float") return {Kind::kNumber, {}, name};
  if (name == "bool") return {Kind::kBool, {}, name};
  if (name == "str") return {Kind::kText, {}, name};
  if (name == "PathLike") return {Kind::kPath, {}, name};
  if (name == "dict") return {Kind::kDict, {}, name};
  if (name == "Sequence" || name == "list") return {Kind::kSequence, items, name};
  if (name == "Mapping") return {Kind::kMapping, items, name};
  if (name == "Callable") return {Kind::kCallable, {}, name};
  if (text.starts_with("bathyal.")) return {Kind::kClass, {}, name};
  return {Kind::kAnything, {}, name};
}

/// A number is "SupportsFloat | SupportsIndex", a path "PathLike | str | bytes": one kind each.
std::vector<Type> read_alternatives(std::string_view text) {
  std::vector<Type> types;
  bool number = false;
  bool path = false;
  for (const std::string_view part : split_outside_brackets(text, " | ")) {
    const Type type = read_type(part);
    if (number && type.name == "SupportsIndex") continue;
    if (path && (type.kind == Kind::kText || type.name == "bytes")) continue;
    number = type.name.starts_with("Supports");
    path = path || type.kind == Kind::kPath;
    types.push_back(type);
  }
  return types;
}

bool is_text(py::handle value) {
  return PyUnicode_Check(value.ptr()) != 0 || PyBytes_Check(value.ptr()) != 0;
}

bool is_utf8(py::handle value) {
  if (PyUnicode_Check(value.ptr()) == 0 || PyUnicode_AsUTF8(value.ptr()) != nullptr) return true;
  PyErr_Clear();
  return false;
}

bool is_path(py::handle value) {
  PyObject* bytes = nullptr;
  if (PyUnicode_FSConverter(value.ptr(), static_cast<void*>(&bytes)) != 0) {
    Py_XDECREF(bytes);
    return true;
  }
  PyErr_Clear();
  return false;
}

template <class Slot>
bool has_slot(py::handle value, Slot PyNumberMethods::*slot) {
  const PyNumberMethods* numbers = Py_TYPE(value.ptr())->tp_as_number;
  return numbers != nullptr && numbers->*slot != nullptr;
}

bool is_whole_number(py::handle value) {
  if (PyFloat_Check(value.ptr()) != 0) return false;
  py::object number = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  if (!number && has_slot(value, &PyNumberMethods::nb_int)) {
    PyErr_Clear();
    number = py::reinterpret_steal<py::object>(PyNumber_Long(value.ptr()));
  }
  PyErr_Clear();
  return static_cast<bool>(number);
}

/// A whole number beyond the range of double is one all the same.
bool is_number(py::handle value) {
  PyFloat_AsDouble(value.ptr());
  const bool fits = PyErr_Occurred() == nullptr || PyErr_ExceptionMatches(PyExc_OverflowError) != 0;
  PyErr_Clear();
  return fits;
}

bool is_bool(py::handle value) {
  return value.is_none() || has_slot(value, &PyNumberMethods::nb_bool);
}

bool is_object_of(std::string_view name, py::handle value) {
  for (py::handle type = py::type::handle_of(value); type;) {
    if (std::string(py::str(type.attr("__name__"))) == name) return true;
    const py::tuple bases = type.attr("__bases__");
    type = bases.empty() ? py::handle() : py::handle(bases[0]);
  }
  return false;
}

/// Whether __init__ has run, where `value` is of a bound class.
bool is_initialised(py::handle value) {
  auto* metaclass = py::detail::get_internals().default_metaclass;
  if (PyObject_TypeCheck(reinterpret_cast<PyObject*>(Py_TYPE(value.ptr())), metaclass) == 0) {
    return true;
  }
  auto* instance = reinterpret_cast<py::detail::instance*>(value.ptr());
  const py::detail::value_and_holder holder = instance->get_value_and_holder();
  return holder.value_ptr() != nullptr;
}

bool is_sequence(py::handle value) { return PySequence_Check(value.ptr()) != 0 && !is_text(value); }

/// The first item that is not of the type, or the size.
std::size_t first_misfit(std::string_view type, const py::sequence& values) {
  std::size_t i = 0;
  while (i < values.size() && type_fits(type, py::object(values[i]))) ++i;
  return i;
}

bool fits(const Type& type, py::handle value) {
  switch (type.kind) {
    case Kind::kAnything:
      return is_initialised(value);
    case Kind::kNothing:
      return value.is_none();
    case Kind::kWholeNumber:
      return is_whole_number(value);
    case Kind::kNumber:
      return is_number(value);
    case Kind::kBool:
      return is_bool(value);
    case Kind::kText:
      return is_text(value) && is_utf8(value);
    case Kind::kPath:
      return is_path(value);
    case Kind::kDict:
      return PyDict_Check(value.ptr()) != 0;
    case Kind::kSequence: {
      if (!is_sequence(value)) return false;
      const auto values = py::reinterpret_borrow<py::sequence>(value);
      return type.items.empty() || first_misfit(type.items[0], values) == values.size();
    }
    case Kind::kMapping: {
      if (PyDict_Check(value.ptr()) == 0) return py::hasattr(value, "items");
      for (const auto& [key, item] : py::reinterpret_borrow<py::dict>(value)) {
        if (type.items.size() != 2) break;
        if (!type_fits(type.items[0], key) || !type_fits(type.items[1], item)) return false;
      }
      return true;
    }
    case Kind::kCallable:
      return PyCallable_Check(value.ptr()) != 0;
    case Kind::kClass:
      return is_object_of(type.name, value) && is_initialised(value);
  }
  return true;
}

std::string describe(const Type& type) {
  switch (type.kind) {
    case Kind::kAnything:
      return "an object";
    case Kind::kNothing:
      return "None";
    case Kind::kWholeNumber:
      return "a whole number";
    case Kind::kNumber:
      return "a number";
    case Kind::kBool:
      return "True or False";
    case Kind::kText:
      return "text";
    case Kind::kPath:
      return "a path";
    case Kind::kDict:
      return "a dict";
    case Kind::kSequence:
      return "a sequence" +
             (type.items.empty() ? "" : ", each item " + describe_type(type.items[0]));
    case Kind::kMapping:
      if (type.items.size() != 2) return "a dict";
      return "a dict of " + describe_type(type.items[0]) + " to " + describe_type(type.items[1]);
    case Kind::kCallable:
      return "a function";
    case Kind::kClass:
      break;
  }
  const bool vowel = std::string_view("AEIOU").find(type.name[0]) != std::string_view::npos;
  return (vowel ? "an " : "a ") + std::string(type.name);
}

}  // namespace

std::vector<std::string_view> split_outside_brackets(std::string_view text,
                                                     std::string_view separator) {
  std::vector<std::string_view> parts;
  int depth = 0;
  char quote = '\0';
  std::size_t begin = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != '\0') {
      if (c == '\\') ++i;
      if (c == quote) quote = '\0';
    } else if (c == '\'' || c == '"') {
      quote = c;
    } else if (c == '(' || c == '[' || c == '{') {
      ++depth;
    } else if (c == ')' || c == ']' || c == '}') {
      --depth;
    } else if (depth == 0 && text.substr(i).starts_with(separator)) {
      parts.push_back(text.substr(begin, i - begin));
      begin = i + separator.size();
      i = begin - 1;
    }
  }
  parts.push_back(text.substr(begin));
  return parts;
}

bool type_fits(std::string_view type, py::handle value) {
  for (const Type& one : read_alternatives(type)) {
    if (fits(one, value)) return true;
  }
  return false;
}

std::string describe_type(std::string_view type) {
  std::string text;
  for (const Type& one : read_alternatives(type)) {
    text += (text.empty() ? "" : " or ") + describe(one);
  }
  return text;
}

std::string describe_misfit(std::string_view type, py::handle value) {
  if (value.is_none()) return "None";
  if (!is_initialised(value)) return "one whose __init__ has not run";
  const std::string name = py::str(py::type::handle_of(value).attr("__name__"));
  for (const Type& one : read_alternatives(type)) {
    if ((one.kind == Kind::kText || one.kind == Kind::kPath) && is_text(value)) {
      return one.kind == Kind::kText ? "text that is no Unicode" : "a name that no file can have";
    }
    if (one.kind != Kind::kSequence || one.items.empty() || !is_sequence(value)) continue;
    const auto values = py::reinterpret_borrow<py::sequence>(value);
    const std::size_t at = first_misfit(one.items[0], values);
    if (at == values.size()) continue;
    return describe_misfit(one.items[0], py::object(values[at])) + " in item " + std::to_string(at);
  }
  return name;
}

std::string range_missed(std::string_view type, py::handle value, bool surely) {
  for (const Type& one : read_alternatives(type)) {
    if (one.kind == Kind::kNumber && PyLong_Check(value.ptr()) != 0) {
      PyLong_AsDouble(value.ptr());
      if (PyErr_Occurred() == nullptr) continue;
      PyErr_Clear();
      return "a number within the range of float";
    }
    if (one.kind == Kind::kSequence && one.items.size() == 1 && is_sequence(value)) {
      for (const py::handle item : py::reinterpret_borrow<py::sequence>(value)) {
        std::string range = range_missed(one.items[0], item, surely);
        if (!range.empty()) return "each item " + range;
      }
    }
    if (one.kind != Kind::kWholeNumber) continue;
    const auto number = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
    if (!number) {
      PyErr_Clear();
      continue;
    }
    int overflow = 0;
    const long long wide = PyLong_AsLongLongAndOverflow(number.ptr(), &overflow);
    if (overflow != 0) return "a whole number of 64 bits";
    if (surely) continue;
    if (wide > std::numeric_limits<int>::max()) return "a whole number up to 2147483647";
    if (wide < std::numeric_limits<int>::min()) return "a whole number from -2147483648 on";
    if (wide < 0) return "a whole number of 0 or more";
  }
  return {};
}

std::string short_text(py::handle value) {
  constexpr std::size_t kLength = 60;
  std::string text = py::repr(value);
  if (text.size() > kLength) text = text.substr(0, kLength) + "…";
  return text;
}

}  // namespace bathyal::python
