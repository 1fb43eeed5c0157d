// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/velodyne_lidar.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "datmo_fusion/common/angle.h"

namespace datmo {

namespace {

constexpr TickFormat kVelodyneTicks{1e-6, 3600000000};  // to the hour

/// s; packets are late by up to this if they overtook each other in the network. An older time
/// means that the clock was set.
constexpr double kReordered = 0.1;

constexpr double kLongestTurn = 0.5;  ///< s; the slowest of all lidars takes 0.2 s
/// s, longest gap in a turn that is still published: half of the fastest turn, so that no gap hides
/// the end of a turn.
constexpr double kLongestGap = 0.025;

constexpr int kMaxBadPackets = 100;  ///< in a row: it is not a lidar

constexpr const char* kAuto = "auto";

}  // namespace

void VelodyneOptions::visit(OptionVisitor& visitor) {
  std::vector<std::string> names{kAuto};
  for (const VelodyneModel& known : velodyneModels()) {
    names.push_back(known.name);
  }
  visitor.text({"model", "", "auto: as its packets report, which those of old firmware do not"},
               model, names);
  visitor.number({"min_range", "m", "nearer returns are ignored: the mount and the lidar itself"},
                 min_range, {0.0, 10.0});
  visitor.number({"max_range", "m", "farther returns are ignored"}, max_range, {1.0, 300.0});
  visitor.number({"seam", "rad",
                  "bearing about the lidar where a turn ends and the next begins: best where "
                  "little happens"},
                 seam, {-kPi, kPi});
}

VelodyneLidar::VelodyneLidar(PacketOpener open, VelodyneOptions options, const DeviceHost& host)
    : open_(std::move(open)), options_(std::move(options)), host_(host) {
  constexpr double kHundredths = 100.0;
  // Azimuth is clockwise.
  const auto seam = std::lround(-toDegrees(options_.seam) * kHundredths);
  seam_ = static_cast<unsigned>(seam + VelodynePacket::kFullTurn) % VelodynePacket::kFullTurn;
}

std::string VelodyneLidar::connect() {
  source_ = open_();
  host_.clock.restart(kVelodyneTicks);
  packet_ = nextPacket();
  model_ = &modelOf(*packet_);
  readTime(*packet_);
  return model_->name + (packet_->isDual() ? ", two returns" : ", one return");
}

VelodynePacket VelodyneLidar::nextPacket() {
  for (int bad = 1;; ++bad) {
    try {
      const VelodynePacket packet(source_->next());
      if (model_ == nullptr || isOf(*model_, packet)) {
        return packet;
      }
      throw DeviceError("wrong_device",
                        "a packet of another product (" + std::to_string(packet.product()) +
                            ") than " + model_->name +
                            ": expected one lidar per port; distinguish them by their addresses");
    } catch (const RecordingEnd&) {
      throw;
    } catch (const DeviceError& error) {
      const bool is_bad = error.reason() == "bad_packet" || error.reason() == "wrong_device";
      if (!is_bad || bad >= kMaxBadPackets) {
        throw;
      }
      host_.warn(error);
    }
  }
}

bool VelodyneLidar::isOf(const VelodyneModel& model, const VelodynePacket& packet) const {
  if (packet.product() == model.product) {
    return true;
  }
  // Old firmware has other data there, but hardly the product number of another model.
  const auto& models = velodyneModels();
  return options_.model != kAuto &&
         std::none_of(models.begin(), models.end(), [&packet](const VelodyneModel& other) {
           return packet.product() == other.product;
         });
}

const VelodyneModel& VelodyneLidar::modelOf(const VelodynePacket& packet) const {
  const auto& models = velodyneModels();
  const auto found = std::find_if(models.begin(), models.end(), [&](const VelodyneModel& model) {
    return (options_.model == kAuto || options_.model == model.name) && isOf(model, packet);
  });
  if (found == models.end()) {
    std::string known;
    for (const VelodyneModel& model : models) {
      known += std::to_string(model.product) + " (" + model.name + "), ";
    }
    throw DeviceError(
        "wrong_device",
        "a lidar with product number " + std::to_string(packet.product()) + ": expected one of " +
            known + "and that of velodyne/model if it names one; name it only for old firmware");
  }
  return *found;
}

bool VelodyneLidar::isLate(const VelodynePacket& packet) const {
  const double since = host_.clock.hasMessage() ? host_.clock.sinceLast(packet.time()) : 1.0;
  if (since > 0.0 || since <= -kReordered) {
    return false;
  }
  host_.warn({"late_packet", "a packet " + std::to_string(-since) +
                                 " s older than the last one: expected them in order"});
  return true;
}

void VelodyneLidar::readTime(const VelodynePacket& packet) {
  const double span = packetSpan(*model_, packet.isDual());
  const bool is_first = !host_.clock.hasMessage();
  // A packet is sent after its last firing.
  const Stamp stamp = host_.clock.add(packet.time(), model_->stamped_last ? 0.0 : span);
  packet_stamp_ = model_->stamped_last ? stamp + -span : stamp;
  next_block_ = 0;
  const double interval = host_.clock.interval();
  missed_ += missedIn(interval, blockOffset(*model_, packet.isDual(), VelodynePacket::kBlocks));
  const bool is_set = interval <= 0.0 && !is_first;
  if (is_set || interval > kLongestGap) {
    turn_.reset();
    age_ = 0.0;
    return;
  }
  age_ += interval;
  if (age_ > kLongestTurn) {
    throw DeviceError("device_fault", "the lidar has not turned once in " +
                                          std::to_string(kLongestTurn) +
                                          " s: expected at least five turns a second");
  }
}

DeviceMeasurement VelodyneLidar::next() {
  while (true) {
    if (std::optional<DeviceMeasurement> measurement = readBlocks()) {
      return *std::move(measurement);
    }
    do {
      packet_ = nextPacket();
    } while (isLate(*packet_));
    readTime(*packet_);
  }
}

std::optional<DeviceMeasurement> VelodyneLidar::readBlocks() {
  constexpr unsigned kFullTurn = VelodynePacket::kFullTurn;
  const RangeLimits limits{options_.min_range, options_.max_range};
  while (next_block_ < VelodynePacket::kBlocks) {
    const std::size_t block = next_block_;
    const unsigned angle = (packet_->azimuth(block) + kFullTurn - seam_) % kFullTurn;
    // Smaller by more than the encoder's noise.
    const bool is_new = angle + kFullTurn / 2 < last_angle_;
    last_angle_ = angle;
    if (is_new) {
      if (std::optional<DeviceMeasurement> measurement = endTurn(block)) {
        return measurement;  // the block belongs to the next turn, which has begun
      }
    }
    if (turn_) {
      appendPoints(*packet_, block, *model_, limits,
                   age_ + blockOffset(*model_, packet_->isDual(), block), turn_->cloud.points);
    }
    ++next_block_;
  }
  return std::nullopt;
}

std::optional<DeviceMeasurement> VelodyneLidar::endTurn(std::size_t block) {
  const double offset = blockOffset(*model_, packet_->isDual(), block);
  std::optional<DeviceMeasurement> measurement;
  if (turn_) {
    measurement.emplace();
    measurement->stamp = turn_->stamp;
    measurement->missed = std::exchange(missed_, 0);
    last_points_ = turn_->cloud.points.size();
    measurement->data = std::move(turn_->cloud);
  }
  turn_.emplace();
  turn_->stamp = packet_stamp_ + offset;
  age_ = -offset;
  turn_->cloud.points.reserve(last_points_ + last_points_ / 8);
  return measurement;
}

}  // namespace datmo
