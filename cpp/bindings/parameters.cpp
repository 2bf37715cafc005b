// SPDX-License-Identifier: BSD-3-Clause
#include "parameters.hpp"

#include <optional>

namespace bathyal::python {
namespace {

namespace py = pybind11;

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

void add_parameter(std::string_view text, Signature& signature, bool& keyword_only) {
  text = trimmed(text);
  if (text.empty() || text == "/") return;
  if (text == "*") {
    keyword_only = true;
  } else if (text.starts_with("**")) {
    signature.any_named = true;
  } else if (text.starts_with("*")) {
    signature.any_positional = true;
    keyword_only = true;
  } else {
    const std::size_t colon = text.find(": ");
    const std::vector<std::string_view> parts =
        split_outside_brackets(text.substr(colon + 2), " = ");
    signature.parameters.push_back({std::string(text.substr(0, colon)), std::string(parts[0]),
                                    parts.size() > 1, keyword_only});
  }
}

/// The arguments of a call by the parameters they are for; a null handle where there is none.
struct Bound {
  std::vector<py::handle> values;
  std::optional<std::string> fault;
};

Bound bind_arguments(const Signature& signature, const std::string& function,
                     PyObject* const* arguments, std::size_t count, PyObject* names) {
  Bound bound{std::vector<py::handle>(signature.parameters.size()), {}};
  std::size_t places = 0;
  while (places < signature.parameters.size() && !signature.parameters[places].keyword_only) {
    ++places;
  }
  if (count > places && !signature.any_positional) {
    bound.fault = "`" + function + "`: expected at most " + std::to_string(places) +
                  " arguments without a name, got " + std::to_string(count);
    return bound;
  }
  for (std::size_t i = 0; i < std::min(count, places); ++i) bound.values[i] = arguments[i];
  const std::size_t named = names == nullptr ? 0 : static_cast<std::size_t>(PyTuple_Size(names));
  for (std::size_t k = 0; k < named; ++k) {
    const std::string name = py::str(PyTuple_GET_ITEM(names, static_cast<py::ssize_t>(k)));
    std::size_t i = 0;
    while (i < signature.parameters.size() && signature.parameters[i].name != name) ++i;
    const bool known = i < signature.parameters.size();
    if (known && bound.values[i]) {
      bound.fault = "`" + name + "`: expected one value, got two";
    } else if (known) {
      bound.values[i] = arguments[count + k];
    } else if (!signature.any_named) {
      bound.fault =
          "`" + name + "`: expected an argument of " + function + ", got one that it does not have";
    }
    if (bound.fault) return bound;
  }
  for (std::size_t i = 0; i < signature.parameters.size(); ++i) {
    const Parameter& parameter = signature.parameters[i];
    if (bound.values[i] || parameter.has_default) continue;
    bound.fault = "`" + parameter.name + "`: expected " + describe_type(parameter.type) +
                  ", got no such argument";
    return bound;
  }
  return bound;
}

std::string expected_got(const Parameter& parameter, const std::string& expected,
                         const std::string& got) {
  return "`" + parameter.name + "`: expected " + expected + ", got " + got;
}

/// A fault, how far the call got before it, and of a wrong type the parameter and what it was
/// given.
struct Found {
  Misfit misfit;
  std::size_t at = 0;
  Parameter parameter = {};
  py::handle value = {};
};

Found wrong_type(const Parameter& parameter, py::handle value, std::size_t at) {
  return {{PyExc_TypeError, expected_got(parameter, describe_type(parameter.type),
                                         describe_misfit(parameter.type, value))},
          at,
          parameter,
          value};
}

Found find_in(const Signature& signature, const std::string& function, bool is_constructor,
              PyObject* const* arguments, std::size_t count, PyObject* names) {
  Bound bound = bind_arguments(signature, function, arguments, count, names);
  if (bound.fault) return {{PyExc_TypeError, *bound.fault}, 0};
  if (is_constructor) bound.values[0] = py::handle();  // about to be made
  for (std::size_t i = 0; i < bound.values.size(); ++i) {
    const Parameter& parameter = signature.parameters[i];
    if (!bound.values[i] || type_fits(parameter.type, bound.values[i])) continue;
    return wrong_type(parameter, bound.values[i], i + 1);
  }
  for (const bool surely : {true, false}) {
    for (std::size_t i = 0; i < bound.values.size(); ++i) {
      const Parameter& parameter = signature.parameters[i];
      if (!bound.values[i]) continue;
      const std::string range = range_missed(parameter.type, bound.values[i], surely);
      if (range.empty()) continue;
      return {{PyExc_ValueError, expected_got(parameter, range, short_text(bound.values[i]))},
              i + 1};
    }
  }
  return {
      {PyExc_TypeError, "`" + function + "`: expected other arguments, got some that do not fit"},
      0};
}

/// A constructor goes by the name of its class.
std::string name_of(const py::detail::function_record& record) {
  if (!record.is_constructor) return record.name;
  return py::str(record.scope.attr("__name__"));
}

}  // namespace

Signature parse_signature(std::string_view text) {
  Signature signature;
  bool keyword_only = false;
  const std::string_view arguments = split_outside_brackets(text, " -> ").front();
  const std::string_view inside = arguments.substr(1, arguments.size() - 2);
  for (const std::string_view part : split_outside_brackets(inside, ", ")) {
    add_parameter(part, signature, keyword_only);
  }
  return signature;
}

Misfit find_misfit(const py::detail::function_record& record, PyObject* const* arguments,
                   std::size_t count, PyObject* names) {
  const std::string function = name_of(record);
  std::optional<Found> furthest;
  for (const auto* overload = &record; overload != nullptr; overload = overload->next) {
    Signature signature = parse_signature(overload->signature);
    if (overload->is_method) signature.parameters.front().name = "self";  // of a property: "arg0"
    Found found = find_in(signature, function, overload->is_constructor, arguments, count, names);
    if (!furthest || found.at > furthest->at) {
      furthest = std::move(found);
    } else if (found.at == furthest->at && found.value && furthest->value) {
      found.parameter.type = furthest->parameter.type + " | " + found.parameter.type;
      furthest = wrong_type(found.parameter, found.value, found.at);
    }
  }
  return furthest->misfit;
}

}  // namespace bathyal::python
