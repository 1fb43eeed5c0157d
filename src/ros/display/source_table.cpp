// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/display/source_table.h"

#include <cstdio>

namespace datmo {

namespace {

using diagnostic_msgs::DiagnosticStatus;
using diagnostic_msgs::KeyValue;

/// Names in a stage's report (StageReporter).
constexpr char kReceived[] = " received";
constexpr char kRate[] = " rate [Hz]";
constexpr char kAge[] = " age [s]";
constexpr char kLatency[] = "latency, last [ms]";
constexpr char kTime[] = "processing time, median [ms]";
constexpr char kDropped[] = "dropped";
constexpr char kReason[] = "dropped: ";

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::string valueOf(const DiagnosticStatus& status, const std::string& key) {
  for (const KeyValue& entry : status.values) {
    if (entry.key == key) {
      return entry.value;
    }
  }
  return "";
}

/// "grid_slam: stage" -> "grid_slam", "/drivers: lidar" -> "drivers: lidar".
std::string stageOf(const std::string& name) {
  constexpr char kStage[] = ": stage";
  const std::string plain = name.substr(name.rfind('/', 0) == 0 ? 1 : 0);
  return endsWith(plain, kStage) ? plain.substr(0, plain.size() - sizeof(kStage) + 1) : plain;
}

std::string reasonsOf(const DiagnosticStatus& status) {
  std::string reasons;
  for (const KeyValue& entry : status.values) {
    if (entry.key.rfind(kReason, 0) == 0) {
      reasons +=
          (reasons.empty() ? "" : ", ") + entry.key.substr(sizeof(kReason) - 1) + " " + entry.value;
    }
  }
  return reasons;
}

std::vector<SourceRow> rowsOf(const DiagnosticStatus& status) {
  std::vector<SourceRow> rows;
  SourceRow row;
  row.stage = stageOf(status.name);
  row.level = static_cast<std::uint8_t>(status.level);
  row.state = status.message;
  row.latency = valueOf(status, kLatency);
  row.time = valueOf(status, kTime);
  row.dropped = valueOf(status, kDropped);
  row.why = reasonsOf(status);
  for (const KeyValue& entry : status.values) {
    if (!endsWith(entry.key, kReceived)) {
      continue;
    }
    row.input = entry.key.substr(0, entry.key.size() - sizeof(kReceived) + 1);
    row.rate = valueOf(status, row.input + kRate);
    row.age = valueOf(status, row.input + kAge);
    rows.push_back(row);
    row.latency = row.time = row.dropped = row.why = row.state = "";
  }
  if (rows.empty()) {
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

void SourceTable::update(const diagnostic_msgs::DiagnosticArray& message, double now) {
  for (const DiagnosticStatus& status : message.status) {
    nodes_[status.name] = {now, rowsOf(status)};
  }
}

std::vector<SourceRow> SourceTable::rows(double now, double silence) const {
  std::vector<SourceRow> rows;
  for (const auto& [name, node] : nodes_) {
    const double silent = now - node.received_at;
    for (SourceRow row : node.rows) {
      if (silent > silence) {
        std::string text(32, '\0');
        text.resize(static_cast<std::size_t>(
            std::snprintf(text.data(), text.size(), "silent for %.0f s", silent)));
        row.level = static_cast<std::uint8_t>(DiagnosticStatus::STALE);
        row.state = row.state.empty() ? "" : text;
      }
      rows.push_back(row);
    }
  }
  return rows;
}

}  // namespace datmo
