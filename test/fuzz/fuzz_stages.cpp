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

#include "fuzz_check.h"
#include "fuzzed_graph.h"
#include "message_kinds.h"
#include "stage_input.h"
#include "stage_mutation.h"

#include <ros/console.h>
#include <ros/time.h>

// Of libFuzzer, which has no header for it.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace datmo::fuzz {
namespace {

constexpr double kMilliseconds = 1e-3;
const Stamp kStart = Stamp::fromSeconds(1000.0);  // as the seeds

std::uint64_t messages = 0;  // so far, at doors of their graphs

void printMessages() {
  std::fprintf(stderr, "stat::number_of_messages: %llu\n",
               static_cast<unsigned long long>(messages));
}

/// One input through the stages.
class StageRun {
 public:
  explicit StageRun(const FuzzedGraph& graph)
      : topics_(graph.topics), runner_(graph.sensors, graph.campaign.switches) {}

  void handle(const Door& door, const Record& record) {
    now_ = now_ + kMilliseconds * record.wait;
    if (topics_.count(door.topic) == 0) {
      return;
    }
    ++messages;
    if (const AnyMessage message = decoded(door, record.bytes)) {
      deliver({door.topic, door.data_type, message}, now_, runner_);
      check();
    }
  }

  void finish() {
    runner_.finish(now_);
    check();
  }

 private:
  /// Null if it cannot be decoded: hosts drop it.
  static AnyMessage decoded(const Door& door, const std::vector<std::uint8_t>& bytes) {
    const auto kind = campaign::messageKinds().find(door.data_type);
    if (kind == campaign::messageKinds().end()) {
      return nullptr;
    }
    try {
      return kind->second.decoded(bytes);
    } catch (const std::exception&) {
      return nullptr;
    }
  }

  /// Internal errors and outputs that must not be published, both of which stages drop.
  void check() const {
    for (const StageMonitor* monitor : runner_.monitors()) {
      for (const char* const reason : {"unexpected_error", "bad_output"}) {
        if (monitor->drops().count(reason) > 0) {
          std::fprintf(stderr, "%s: %s: ", monitor->stage().c_str(), reason);
          require(false, monitor->lastDrop().c_str());
        }
      }
    }
  }

  const std::set<std::string>& topics_;
  GraphRunner runner_;
  Stamp now_ = kStart;
};

std::string_view view(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

std::size_t written(StageInput input, std::uint8_t* out, std::size_t max_size) {
  shorten(input, max_size);
  const std::string bytes = encode(input);
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
  const datmo::fuzz::StageInput input =
      datmo::fuzz::decodeStageInput(datmo::fuzz::view(data, size));
  if (!input.records.empty()) {
    const auto& graphs = datmo::fuzz::fuzzedGraphs();
    datmo::fuzz::StageRun run(graphs[input.graph % graphs.size()]);
    for (const datmo::fuzz::Record& record : input.records) {
      run.handle(input.doorOf(record), record);
    }
    run.finish();
  }
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned seed) {
  std::mt19937 random(seed);
  datmo::fuzz::StageInput input = datmo::fuzz::decodeStageInput(datmo::fuzz::view(data, size));
  datmo::fuzz::mutate(input, random, datmo::fuzz::mutateBytes);
  return datmo::fuzz::written(std::move(input), data, max_size);
}

extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* data, std::size_t size,
                                                 const std::uint8_t* other, std::size_t other_size,
                                                 std::uint8_t* out, std::size_t max_size,
                                                 unsigned seed) {
  std::mt19937 random(seed);
  return datmo::fuzz::written(
      datmo::fuzz::crossed(datmo::fuzz::decodeStageInput(datmo::fuzz::view(data, size)),
                           datmo::fuzz::decodeStageInput(datmo::fuzz::view(other, other_size)),
                           random),
      out, max_size);
}
