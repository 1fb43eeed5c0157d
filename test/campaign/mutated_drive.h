// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "run_bag/graph_runner.h"
#include "world.h"

namespace datmo::campaign {

/// What a campaign has done so far.
struct Tally {
  std::uint64_t messages = 0;  ///< that were as they should be
  std::uint64_t mutated = 0;
  std::map<std::string, std::uint64_t> mutated_on;  ///< by topic
  std::map<std::string, std::uint64_t> refused;     ///< by reason, warnings included
  double slowest = 0.0;                             ///< s, for one message and all that follows
  std::string slowest_on;
};

/// One drive through a World and one graph of stages, with mutated messages at its inputs.
class MutatedDrive {
 public:
  /// `seed`: of all that is drawn, the graph included.
  MutatedDrive(const std::string& config, unsigned seed, Tally& tally);

  /// Drives on with mutations, then without. Returns what must not be: "step 12, mutated scan:
  /// ..."; empty: nothing.
  std::vector<std::string> run();

  std::string graph() const { return graph_; }

 private:
  using Mutate = std::function<AnyMessage(const AnyMessage& message, std::mt19937& random)>;
  struct Sample {
    std::string data_type;
    AnyMessage message;
  };

  static const std::map<std::string, Mutate>& mutations();

  void step(double seconds);
  /// Of a stereo camera that is slower than the scanner.
  void sendImages(double seconds);
  void mutateOne(double seconds);
  template <typename Message>
  void send(const std::string& topic, const Message& message, double seconds);
  void deliver(const std::string& topic, Sample sample, double seconds);
  void sendTransforms(const std::vector<geometry_msgs::TransformStamped>& transforms,
                      bool is_static, double seconds);
  void take(const Publications& published);
  void findFaults();
  void note(const std::string& what);

  std::mt19937 random_;
  std::string graph_;
  GraphRunner runner_;
  World world_;
  Tally& tally_;
  std::map<std::string, Sample> samples_;  ///< the last good message by topic
  std::string last_;                       ///< what was sent last
  std::string now_;
  double last_tracks_ = -1.0;  ///< s, stamp
  std::vector<std::string> faults_;
};

}  // namespace datmo::campaign
