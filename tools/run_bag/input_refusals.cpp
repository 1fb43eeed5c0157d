// SPDX-License-Identifier: BSD-3-Clause
#include "input_refusals.h"

#include <set>

#include "command_line.h"

namespace datmo {

namespace {

std::string describe(const std::string& name, const InputRefusals::Topic& topic) {
  std::string text = name + ": all " + std::to_string(topic.received) + " messages were refused";
  std::string separator = ": ";
  for (const auto& [reason, refused] : topic.reasons) {
    text +=
        separator + std::to_string(refused.messages) + " as " + reason + " (" + refused.last + ")";
    separator = ", ";
  }
  return text;
}

}  // namespace

void InputRefusals::book(const std::string& topic) {
  Topic& entry = topics_[topic];
  ++entry.received;
  std::set<std::string> reasons;  // several stages may have received the same message
  for (const StageMonitor* monitor : monitors_) {
    for (const auto& [reason, count] : monitor->drops()) {
      std::uint64_t& seen = seen_[monitor][reason];
      if (count > seen) {
        seen = count;
        entry.reasons[reason].last = monitor->lastError();
        reasons.insert(reason);
      }
    }
  }
  for (const std::string& reason : reasons) {
    ++entry.reasons[reason].messages;
  }
  entry.refused += reasons.empty() ? 0 : 1;
}

void InputRefusals::check() const {
  std::string refused;
  for (const auto& [name, topic] : topics_) {
    if (topic.refused == topic.received) {
      refused += (refused.empty() ? "" : "; ") + describe(name, topic);
    }
  }
  if (!refused.empty()) {
    throw NoUsableInput(refused);
  }
}

}  // namespace datmo
