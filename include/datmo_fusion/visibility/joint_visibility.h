// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/visibility/visibility.h"

namespace datmo {

/// Returns what all sensors together could have seen at the time of a list, in its frame: by the
/// scan of that time (null if none is known), and by each sensor whose view the list contains, with
/// the objects that it saw as occluders. If nothing is known of any sensor, the view is unknown.
Visibility jointVisibility(const Visibility* scan, const ObjectList& list,
                           const VisibilityOptions& options);

}  // namespace datmo
