// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <string_view>
#include <vector>

// The types of parameters as pybind11 writes them in a signature, checked and put in plain English.

namespace bathyal::python {

/// The parts of `text` between `separator`s outside of brackets and quotes; one at
/// least.
std::vector<std::string_view> split_outside_brackets(std::string_view text,
                                                     std::string_view separator);

/// Whether `value` is of the type, its range not looked at. True of a type that is not known here.
bool type_fits(std::string_view type, pybind11::handle value);

/// "a whole number or None"
std::string describe_type(std::string_view type);

/// What `value` is, that is not of the type: "str", "int in item 2".
std::string describe_misfit(std::string_view type, pybind11::handle value);

/// The range that `value`, a number of the right type, misses; empty where it misses none. Ranges
/// of whole numbers are not written in a signature: `surely` finds what fits none of them,
/// otherwise also what does not fit the narrowest (32 bits, or no sign).
std::string range_missed(std::string_view type, pybind11::handle value, bool surely);

/// repr() of a value, cut after 60 characters.
std::string short_text(pybind11::handle value);

}  // namespace bathyal::python
