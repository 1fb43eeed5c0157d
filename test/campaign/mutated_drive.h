// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "campaign_sensors.h"

#include "datmo_fusion/ros/stage/part_clocks.h"

namespace datmo::campaign {

/// Totals of a campaign so far.
struct Tally {
  std::uint64_t messages = 0;  ///< of sensors, valid or mutated in place
  std::uint64_t mutated = 0;   ///< those between stages included
  /// Of these, dropped for their stamp alone: the rest of them was not tested.
  std::uint64_t stopped_by_stamp = 0;
  std::map<std::string, std::uint64_t> mutated_on;    ///< by topic
  std::map<std::string, std::uint64_t> mutated_type;  ///< by type of message
  std::map<std::string, std::uint64_t> refused;       ///< by reason, warnings included
  double slowest = 0.0;  ///< s of CPU time, for one message and all that follows from it
  std::string slowest_on;
};

/// One drive with all sensors through one graph of stages, with mutated messages at its inputs and
/// between its stages.
///
/// Mutated messages replace originals, and mutated copies with later stamps follow after each step,
/// as if all sensors and stages sent at a multiple of their rates.
class MutatedDrive {
 public:
  /// `seed`: of all random draws, including the graph; `max_seconds`: of CPU time, for one message
  /// and all that follows from it.
  MutatedDrive(const std::string& config, unsigned seed, double max_seconds, Tally& tally);

  /// Continues the drive with mutations, then without. Returns what must not happen: "step 12,
  /// mutated scan: ..."; empty: nothing.
  std::vector<std::string> run();

 private:
  bool isTurn(double probability);
  /// Returns the message that a stage gets in place of the original.
  AnyMessage givenFor(const Publication& message);
  AnyMessage mutatedOf(const Publication& message, ros::Duration shift);
  void step(int index, bool mutates);
  void sendCopies();
  void askClock();
  /// `mutated_before`: number of mutated messages before this one.
  void deliver(const Publication& message, std::uint64_t mutated_before);
  /// Records how long it took, and what was dropped.
  void finish(double seconds, std::uint64_t mutated_before);
  std::uint64_t stampDrops() const;
  void take(const Publications& published);
  void findFaults();
  void bookRefused();
  void note(const std::string& what);

  std::mt19937 random_;
  const CampaignGraph& graph_;
  GraphRunner runner_;
  CampaignSensors sensors_;
  PartClocks clocks_;
  double max_seconds_;
  Tally& tally_;
  /// The last good message by topic, and when it was given.
  std::map<std::string, std::pair<Stamp, Publication>> samples_;
  bool mutates_ = false;
  Stamp now_;
  std::string step_;               ///< in words
  std::string last_;               ///< what was sent last
  std::uint64_t stamp_drops_ = 0;  ///< so far
  std::map<const StageMonitor*, std::map<std::string, std::uint64_t>> unexpected_;  ///< so far
  double last_tracks_ = -1.0;                                                       ///< s, stamp
  std::vector<std::string> faults_;
};

}  // namespace datmo::campaign
