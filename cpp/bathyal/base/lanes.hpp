// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What kernels that are written once and compiled for each instruction set share. `V` names the
// vector type `D` of its set, and lives in the kernel's own file.

namespace bathyal {

template <class V>
inline typename V::D load(const double* p) {
  typename V::D value;
  __builtin_memcpy(&value, p, sizeof value);
  return value;
}

template <class V>
inline void store(double* p, typename V::D value) {
  __builtin_memcpy(p, &value, sizeof value);
}

}  // namespace bathyal
