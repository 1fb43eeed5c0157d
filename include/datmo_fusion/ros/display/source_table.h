// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <diagnostic_msgs/DiagnosticArray.h>

namespace datmo {

/// One row of the table of sources: an input of a stage, or, with an empty `input`, a node that has
/// none. Cells have the text of the diagnostics; empty: not reported.
struct SourceRow {
  std::string stage;
  std::string input;
  std::uint8_t level = 0;  ///< DiagnosticStatus.OK, WARN, ERROR, STALE
  std::string state;       ///< in words: "runs", "no scan for 2.0 s"
  std::string rate;        ///< Hz
  std::string age;         ///< s, of the last message
  std::string latency;     ///< ms, from the measurement to the result
  std::string time;        ///< ms, median processing time
  std::string dropped;     ///< number of messages
  std::string why;         ///< reasons and counts: "old_stamp 3, bad_pose 1"
};

/// Keeps each node's last report in /diagnostics.
class SourceTable {
 public:
  /// `now`: s, of any monotonic clock.
  void update(const diagnostic_msgs::DiagnosticArray& message, double now);

  /// Rows by stage and input. Only the first row of a stage has latency, time and drops. A node
  /// that has not reported for longer than `silence` (s) is stale.
  std::vector<SourceRow> rows(double now, double silence = 5.0) const;

  void clear() { nodes_.clear(); }

 private:
  struct Node {
    double received_at = 0.0;
    std::vector<SourceRow> rows;
  };
  std::map<std::string, Node> nodes_;
};

}  // namespace datmo
