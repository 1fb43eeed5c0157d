// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>

#include "datmo_fusion/common/object.h"

namespace datmo {

/// Returns the names of a source's sensors in its objects. They may differ from the source's name,
/// `front_radar` from `radar`, and two sources may have the same sensor.
///
/// @param source its name
/// @param list its objects and views at one time
std::set<std::string> sensorsOf(const std::string& source, const ObjectList& list);

/// Whether an object is only a class for other sources' objects rather than an observation of its
/// own (MonoClassifier): no side was seen, no velocity was measured, and all its sensors are those
/// of others. One detection may name several pieces of a vehicle, which is evidence neither of
/// their existence nor of their motion.
bool isClassOnly(const Object& object, const std::set<std::string>& sensors_of_others);

}  // namespace datmo
