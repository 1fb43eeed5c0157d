// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>

#include "datmo_fusion/common/object.h"

namespace datmo {

/// What a source's objects call its sensors. It may have another name than they have, `front_radar`
/// than `radar`, and two sources may have the same sensor.
///
/// @param source its name
/// @param list its objects and views at one time
std::set<std::string> sensorsOf(const std::string& source, const ObjectList& list);

/// Whether it is the class of other sources' objects and no sighting of its own (MonoClassifier):
/// it saw no side and measured no velocity, and all its sensors are those of others. One detection
/// may name several pieces of a vehicle, which exist no more surely for it, nor does any of them
/// move.
bool isName(const Object& object, const std::set<std::string>& sensors_of_others);

}  // namespace datmo
