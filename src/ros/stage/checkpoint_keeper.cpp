// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/checkpoint_keeper.h"

#include <exception>
#include <filesystem>
#include <new>
#include <utility>

namespace datmo {

void CheckpointOptions::visit(OptionVisitor& visitor) {
  visitor.text({"file", "",
                "absolute path of a file from which SLAM continues in its map when its process was "
                "killed, or it was unloaded, and loaded again (perception.launch); empty: it "
                "starts a new map. Used only live"},
               file, {});
  visitor.text({"run", "",
                "name of this start of the stack: a file of another one is ignored "
                "(perception.launch)"},
               run, {});
  visitor.number({"interval", "s",
                  "minimum time between two maps written to the file, by the scans' stamps; the "
                  "pose is written after each scan"},
                 interval, {0.1, 10.0});
  visitor.number({"max_age", "s",
                  "an older state is ignored: longer than a restart takes; with the speed known "
                  "at both ends only, a car is then uncertain by more than recovery/"
                  "lost_from_sigma, and cannot be searched for"},
                 max_age, {0.1, 600.0});
}

CheckpointKeeper::CheckpointKeeper(const Checked<CheckpointOptions>& options,
                                   std::map<std::string, std::string> stage_options,
                                   std::size_t max_cells, StageMonitor& monitor)
    : options_(*options),
      stage_options_(std::move(stage_options)),
      monitor_(monitor),
      worker_([this](const Job& job) { return write(job); }, true) {
  read(max_cells);
}

void CheckpointKeeper::read(std::size_t max_cells) {
  std::error_code unusable;
  if (!std::filesystem::exists(options_.file, unusable)) {
    return;
  }
  try {
    earlier_ = readCheckpoint(options_.file, max_cells);
  } catch (const std::exception& error) {  // out of memory, too
    monitor_.warned(
        InputError("bad_checkpoint", std::string(error.what()) + ": starts with a new map"));
  }
}

std::string CheckpointKeeper::differenceOf(const Checkpoint& checkpoint) const {
  for (const auto& [key, value] : stage_options_) {
    const auto then = checkpoint.options.find(key);
    if (then == checkpoint.options.end() || then->second != value) {
      return key + " was " + (then == checkpoint.options.end() ? "missing" : then->second) +
             ", expected " + value;
    }
  }
  return "";
}

std::string CheckpointKeeper::refusalOf(const Checkpoint& checkpoint, Stamp first_scan) const {
  const double age = secondsBetween(checkpoint.slam.pose.stamp, first_scan);
  if (!(age > 0.0 && age <= options_.max_age)) {
    return "its pose is from " + toText(age) +
           " s before the first scan, expected more than 0 and at most " +
           toText(options_.max_age) + " s";
  }
  return differenceOf(checkpoint);
}

std::optional<Checkpoint> CheckpointKeeper::takeAt(Stamp first_scan) {
  std::optional<Checkpoint> earlier = std::exchange(earlier_, std::nullopt);
  if (!earlier || earlier->run != options_.run) {  // the stack was stopped in between, as usual
    return std::nullopt;
  }
  const std::string refusal = refusalOf(*earlier, first_scan);
  if (!refusal.empty()) {
    monitor_.announce("checkpoint",
                      options_.file + ": starts with a new map instead of its map: " + refusal);
    return std::nullopt;
  }
  const double age = secondsBetween(earlier->slam.pose.stamp, first_scan);
  monitor_.figure("age of the checkpoint at the start [s]", age);
  monitor_.condition(HealthLevel::kOk, "continues from a checkpoint of " + toText(age) +
                                           " s before, in the same map");
  return earlier;
}

CheckpointKeeper::Result CheckpointKeeper::write(const Job& job) const {
  try {
    if (job.window) {
      return {writeCheckpoint(options_.file, {options_.run, stage_options_, job.slam, *job.window}),
              ""};
    }
    writePose(options_.file, job.id, job.slam);
    return {job.id, ""};
  } catch (const std::exception& error) {  // out of memory, too
    return {0, error.what()};
  }
}

void CheckpointKeeper::takeResults() {
  for (const Result& result : worker_.take()) {
    id_ = result.error.empty() ? std::make_optional(result.id) : std::nullopt;
    if (!id_) {
      monitor_.warned(
          InputError("checkpoint_not_written",
                     result.error + ": if the process is killed, a new map will begin"));
    }
  }
}

bool CheckpointKeeper::isMapDue(const SlamState& state) const {
  return !last_map_ || secondsBetween(*last_map_, state.pose.stamp) >= options_.interval ||
         state.map.maps_begun != maps_begun_;
}

void CheckpointKeeper::keep(const GridSlam& slam) {
  if (worker_.isBusy()) {
    return;
  }
  takeResults();
  if (const auto state = slam.state()) {
    start(*state, isMapDue(*state) ? &slam : nullptr);
  }
}

void CheckpointKeeper::start(SlamState state, const GridSlam* with_map_of) {
  if (with_map_of != nullptr) {
    last_map_ = state.pose.stamp;
    maps_begun_ = state.map.maps_begun;
    worker_.start({std::move(state), with_map_of->map().windowEvidence(), 0});
  } else if (id_) {
    worker_.start({std::move(state), std::nullopt, *id_});
  }
}

void CheckpointKeeper::finish(const GridSlam& slam) {
  worker_.waitUntilIdle();
  try {
    if (const auto state = slam.state()) {
      start(*state, &slam);
      worker_.waitUntilIdle();
    }
    takeResults();
  } catch (const std::bad_alloc&) {
    // The file keeps an earlier state, which is still valid.
  }
}

void CheckpointKeeper::reset() {
  worker_.waitUntilIdle();
  takeResults();
  earlier_.reset();
  last_map_.reset();
  id_.reset();
  removeCheckpoint(options_.file);
}

}  // namespace datmo
