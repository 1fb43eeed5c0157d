// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/visibility/visibility.h"

namespace datmo {

/// What all sensors together could have seen at the time of a list, in its frame: the scan of that
/// time (null: none is known), and each sensor whose view the list contains, to which the objects
/// that it saw hide what is behind them. Where nothing is known of any sensor, the view is unknown.
Visibility jointVisibility(const Visibility* scan, const ObjectList& list,
                           const VisibilityOptions& options);

}  // namespace datmo
