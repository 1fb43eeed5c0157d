// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace datmo {

/// Argument of a nodelet that load_nodelet has loaded into another process, because its manager had
/// ended: the number of times so far follows.
inline constexpr char kRestartsArgument[] = "--restarts";

}  // namespace datmo
