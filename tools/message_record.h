// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rosbag/message_instance.h>

namespace datmo {

/// Throws InputError `undecodable_message`, with topic and time, unless the message's record lies
/// within its chunk. rosbag does not check this, and reads past its memory if one bit of the index
/// or of a length is wrong: to be called before anything else reads the message.
void checkRecord(const rosbag::MessageInstance& message);

}  // namespace datmo
