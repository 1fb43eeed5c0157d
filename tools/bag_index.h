// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace datmo {

/// Whether all records that rosbag reads to open `file`, which has no bagFault(), are as long as
/// they can be in a file of this size, and their headers whole. rosbag allocates what a record's
/// length says before it reads it, up to 4 GiB, ends the program by an assertion where there is
/// less memory, and reads past a header whose fields are longer than it.
bool hasPossibleIndex(const std::string& file);

}  // namespace datmo
