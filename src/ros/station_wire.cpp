// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/station_wire.h"

#include <algorithm>
#include <cstddef>

#include <boost/make_shared.hpp>

#include "datmo_fusion/fusion/wire/wire_error.h"
#include "datmo_fusion/ros/stage/input_error.h"
#include "datmo_fusion/ros/stage/stamp_check.h"
#include "datmo_fusion/ros/stage/stamp_range.h"

namespace datmo {

namespace {

/// Period of the low-frequency container (EN 302 637-2, 6.1.3), s.
constexpr double kLowFrequencyPeriod = 0.5;

/// Share of `interval`: a list that is early by this much is still sent, so that lists at exactly
/// that rate, with jitter, are not dropped.
constexpr double kJitterShare = 0.2;

/// If the next list is due later than this many intervals, the clock was set back.
constexpr double kMaxIntervalsAhead = 2.0;

/// Number of datagrams whose echo is recognized: at least one second, ten lists of a CAM and at
/// most eight CPMs each.
constexpr std::size_t kMaxRecent = 90;

}  // namespace

void StationWireOptions::visit(OptionVisitor& visitor) {
  constexpr double kPorts = 65535.0;
  visitor.integer(
      {"port", "1", "UDP port of this computer on which CAM, CPM, SPATEM and MAPEM are received"},
      port, {1.0, kPorts});
  visitor.text({"source", "", "host name or address of their sender; empty: any"}, source, {});
  visitor.text({"destination", "",
                "host name or address to which ours are sent, also a broadcast address; empty: "
                "none are sent"},
               destination, {});
  visitor.integer({"destination_port", "1", "UDP port there"}, destination_port, {1.0, kPorts});
  visitor.number({"interval", "s",
                  "minimum mean time from a CAM and its CPMs to the next; one may be early by a "
                  "fifth of it (EN 302 637-2: 0.1 s to 1 s; its motion rules are not used)"},
                 interval, {0.1, 1.0});
  messages.visit(visitor);
  visitor.group("signals", [&] { signals.visit(visitor); });
}

StationWire::StationWire(const Checked<StationWireOptions>& options, StageMonitor& monitor)
    : options_(*options), monitor_(monitor) {}

StationTracksMessagePtr StationWire::received(std::string_view bytes, Stamp now) {
  monitor_.received("datagrams", now);
  if (std::find(recent_.begin(), recent_.end(), bytes) != recent_.end()) {
    monitor_.figure("own messages received back", static_cast<double>(++own_));
    return nullptr;
  }
  try {
    const StationMessage message = decodeStation(bytes, now, options_.messages);
    checkStampRange(message.list.stamp);
    left_out_ += message.left_out;
    monitor_.figure("objects without number or position", static_cast<double>(left_out_));
    if (message.list.station == own_station_) {
      throw InputError("own_number", "another station sends with our own station number " +
                                         std::to_string(*own_station_) +
                                         ": every station needs its own v2x/station");
    }
    return boost::make_shared<StationTracksMessage>(toMessage(message.list, message.plane));
  } catch (const InputError& error) {
    monitor_.dropped(error);
    return nullptr;
  } catch (const WireError& error) {
    if (error.reason() == "other_message") {
      monitor_.figure("messages of other kinds", static_cast<double>(++others_));
    } else {
      monitor_.dropped(InputError(error.reason(), error.what()));
    }
    return nullptr;
  }
}

bool StationWire::isDue(Stamp stamp) {
  const double early = due_ ? secondsBetween(stamp, *due_) : 0.0;
  const bool is_restart = early > kMaxIntervalsAhead * options_.interval;
  if (!is_restart && early > kJitterShare * options_.interval) {
    return false;
  }
  // After an early list the next one is not due earlier: on average the interval is kept.
  due_ = (due_ && !is_restart ? std::max(*due_, stamp) : stamp) + options_.interval;
  return true;
}

std::vector<std::string> StationWire::toSend(const StationTracksMessage& message) {
  const Stamp stamp = toStamp(message.header.stamp);
  monitor_.received("stations/own", stamp);
  own_station_ = message.station;
  if (!isDue(stamp)) {
    return {};
  }
  const bool low_frequency = !last_low_frequency_ || stamp < *last_low_frequency_ ||
                             secondsBetween(*last_low_frequency_, stamp) >= kLowFrequencyPeriod;
  try {
    const std::optional<OwnTrack> own = ownTrack(message);
    const LocalPlane plane = own ? own->plane : LocalPlane(GeodeticPosition());
    std::vector<std::string> datagrams =
        encodeStation(fromMessage(message, plane), plane, options_.messages, low_frequency);
    last_low_frequency_ = low_frequency ? stamp : last_low_frequency_;
    recent_.insert(recent_.end(), datagrams.begin(), datagrams.end());
    recent_.erase(recent_.begin(), recent_.end() - static_cast<std::ptrdiff_t>(
                                                       std::min(recent_.size(), kMaxRecent)));
    return datagrams;
  } catch (const WireError& error) {
    monitor_.dropped(InputError(error.reason(), error.what()));
    return {};
  }
}

}  // namespace datmo
