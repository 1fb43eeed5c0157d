// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "stage_input.h"

namespace datmo::fuzz {

/// Changes bytes without knowledge of their structure, to at most `max_size` of them.
using MutateBytes = std::function<void(std::vector<std::uint8_t>& bytes, std::size_t max_size)>;

/// Changes a few things of an input, which may be anything: fields of a message; numbers, or bytes,
/// anywhere in it; which messages there are, in which order and when; and the graph.
void mutate(StageInput& input, std::mt19937& random, const MutateBytes& mutate_bytes);

/// Returns the beginning of one input and the end of another one, for the graph of the first.
StageInput crossed(const StageInput& begin, const StageInput& end, std::mt19937& random);

/// Drops the last records until its code has at most `max_size` bytes, or there is none left.
void shorten(StageInput& input, std::size_t max_size);

}  // namespace datmo::fuzz
