// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "fuzzed_drive.h"

namespace datmo::fuzz {

/// Changes bytes without knowledge of their structure, to at most `max_size` of them.
using MutateBytes = std::function<void(std::vector<std::uint8_t>& bytes, std::size_t max_size)>;

/// Changes a few things of a drive, which may be anything: fields of a message; numbers, or bytes,
/// anywhere in it; which messages there are, in which order and when; and the graph. `period`: s,
/// from step to step of the sensors.
void mutate(FuzzedDrive& drive, double period, const MutateBytes& mutate_bytes,
            std::mt19937& random);

/// Returns the beginning of one drive and the end of another one, for the graph of the first.
FuzzedDrive crossed(const FuzzedDrive& begin, const FuzzedDrive& end, std::mt19937& random);

/// Drops the last messages until encode() returns at most `max_size` bytes, or there is none left.
void shorten(FuzzedDrive& drive, std::size_t max_size);

}  // namespace datmo::fuzz
