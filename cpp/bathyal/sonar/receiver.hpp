// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bathyal {

/// What the receiver makes of the power that arrives. All of it is off unless set.
struct ReceiverOptions {
  void check() const;
};

}  // namespace bathyal
