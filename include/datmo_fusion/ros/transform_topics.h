// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Topics of tf2 (REP 105). They are global, so that a namespace does not change them.
namespace datmo {

inline constexpr char kTransformTopic[] = "/tf";
inline constexpr char kStaticTransformTopic[] = "/tf_static";

}  // namespace datmo
