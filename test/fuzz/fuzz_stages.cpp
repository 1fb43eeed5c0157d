// SPDX-License-Identifier: BSD-3-Clause
// Sequences of serialized messages at all inputs of the stages, in each of the campaign's graphs,
// without a master. Mutations know the fields of the messages.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "campaign_sensors.h"
#include "drive_mutation.h"
#include "fuzz_check.h"
#include "fuzzed_drive.h"
#include "fuzzed_graph.h"
#include "message_kinds.h"

#include <ros/console.h>
#include <ros/time.h>

// Of libFuzzer, which has no header for it.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace datmo::fuzz {
namespace {

constexpr double kMilliseconds = 1e-3;

std::uint64_t decoded_messages = 0;  // so far, on topics of their graphs

void printMessages() {
  std::fprintf(stderr, "stat::number_of_messages: %llu\n",
               static_cast<unsigned long long>(decoded_messages));
}

/// One drive through the stages.
class StageRun {
 public:
  explicit StageRun(const FuzzedGraph& graph)
      : topics_(graph.topics), runner_(graph.sensors, graph.campaign.switches) {}

  void handle(const TypedTopic& topic, const TimedMessage& message) {
    now_ = now_ + kMilliseconds * message.wait;
    if (topics_.count(topic.name) == 0) {
      return;
    }
    if (const AnyMessage content = decoded(topic, message.bytes)) {
      ++decoded_messages;
      campaign::handleAny({topic.name, topic.data_type, content}, now_, runner_);
      check();
    }
  }

  void finish() {
    runner_.finish(now_);
    check();
  }

 private:
  /// Null if it cannot be decoded: hosts drop it.
  static AnyMessage decoded(const TypedTopic& topic, const std::vector<std::uint8_t>& bytes) {
    const auto kind = campaign::messageKinds().find(topic.data_type);
    if (kind == campaign::messageKinds().end()) {
      return nullptr;
    }
    try {
      return kind->second.decoded(bytes);
    } catch (const std::exception&) {
      return nullptr;
    }
  }

  void check() const {
    for (const StageMonitor* monitor : runner_.monitors()) {
      for (const char* const reason : campaign::kDefectReasons) {
        if (monitor->drops().count(reason) > 0) {
          std::fprintf(stderr, "%s: %s: ", monitor->stage().c_str(), reason);
          require(false, monitor->lastDrop().c_str());
        }
      }
    }
  }

  const std::set<std::string>& topics_;
  GraphRunner runner_;
  Stamp now_ = Stamp::fromSeconds(World::kStart);  // as the seeds
};

std::string_view view(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

std::size_t written(FuzzedDrive drive, std::uint8_t* out, std::size_t max_size) {
  shorten(drive, max_size);
  const std::string bytes = encode(drive);
  return bytes.copy(reinterpret_cast<char*>(out), max_size);
}

void mutateBytes(std::vector<std::uint8_t>& bytes, std::size_t max_size) {
  const std::size_t size = bytes.size();
  bytes.resize(max_size);
  bytes.resize(LLVMFuzzerMutate(bytes.data(), size, max_size));
}

}  // namespace
}  // namespace datmo::fuzz

extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  ros::Time::init();
  ros::console::set_logger_level(ROSCONSOLE_DEFAULT_NAME, ros::console::levels::Fatal);
  return std::atexit(datmo::fuzz::printMessages);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const datmo::fuzz::FuzzedDrive drive = datmo::fuzz::decodeDrive(datmo::fuzz::view(data, size));
  if (!drive.messages.empty()) {
    const auto& graphs = datmo::fuzz::fuzzedGraphs();
    datmo::fuzz::StageRun run(graphs[drive.graph % graphs.size()]);
    for (const datmo::fuzz::TimedMessage& message : drive.messages) {
      run.handle(drive.topicOf(message), message);
    }
    run.finish();
  }
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned seed) {
  std::mt19937 random(seed);
  datmo::fuzz::FuzzedDrive drive = datmo::fuzz::decodeDrive(datmo::fuzz::view(data, size));
  datmo::fuzz::mutate(drive, datmo::campaign::CampaignSensors::kStep, datmo::fuzz::mutateBytes,
                      random);
  return datmo::fuzz::written(std::move(drive), data, max_size);
}

extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* data, std::size_t size,
                                                 const std::uint8_t* other, std::size_t other_size,
                                                 std::uint8_t* out, std::size_t max_size,
                                                 unsigned seed) {
  std::mt19937 random(seed);
  return datmo::fuzz::written(
      datmo::fuzz::crossed(datmo::fuzz::decodeDrive(datmo::fuzz::view(data, size)),
                           datmo::fuzz::decodeDrive(datmo::fuzz::view(other, other_size)), random),
      out, max_size);
}
