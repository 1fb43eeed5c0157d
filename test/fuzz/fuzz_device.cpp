// SPDX-License-Identifier: BSD-3-Clause
// What devices send: NMEA, CoLa (both dialects), SCIP, Velodyne's packets, CAN logs and signals.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz_check.h"

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/device/can_database.h"
#include "datmo_fusion/device/can_log.h"
#include "datmo_fusion/device/nmea.h"
#include "datmo_fusion/device/scip.h"
#include "datmo_fusion/device/sick_telegram.h"
#include "datmo_fusion/device/velodyne_packet.h"

namespace datmo::fuzz {
namespace {

void checkNmea(std::string_view bytes) {
  NmeaReader reader;
  reader.feed(bytes);
  while (const std::optional<NmeaSentence> sentence = reader.next()) {
    nmeaTime(sentence->field(0));
    if (sentence->type == "GGA") {
      const SatelliteFix fix = nmeaFix(*sentence, 5.0);
      if (fix.kind != SatelliteFix::Kind::kNone) {
        requireFinite(fix.latitude + fix.longitude, "position of a fix");
        requireFinite(fix.sigma, "sigma of a fix");
      }
    } else if (const auto velocity = nmeaVelocity(*sentence)) {
      requireFinite(velocity->speed, "speed over the ground");
      requireFinite(velocity->course, "course over the ground");
    }
  }
}

void checkScan(const DeviceScan& scan) {
  requireFinite(scan.first_bearing, "first bearing");
  requireFinite(scan.beam_spacing, "beam spacing");
  requireFinite(scan.beam_time, "time from beam to beam");
  requireFinite(scan.scan_time, "time from scan to scan");
  for (const float intensity : scan.intensities) {
    requireFinite(static_cast<double>(intensity), "intensity");
  }
}

void checkSick(std::string_view bytes, ColaDialect dialect) {
  ColaReader reader(dialect);
  reader.feed(bytes);
  while (const std::optional<ColaTelegram> telegram = reader.next()) {
    if (telegram->isCalled("sRA DeviceIdent")) {
      sickModel(*telegram);
    } else if (telegram->isCalled("sRA STlms")) {
      isSickWarmingUp(*telegram);
    } else {
      checkScan(sickScan(*telegram, {"LMS111", 20.0}).scan);
    }
  }
}

/// A telegram without its frame, whose checksum random bytes would hardly ever have.
void checkSickScan(std::string_view bytes, ColaDialect dialect) {
  checkScan(sickScan({dialect, std::string(bytes)}, {"LMS111", 20.0}).scan);
}

void checkScip(std::string_view bytes) {
  ScipReader reader;
  reader.feed(bytes);
  std::optional<ScipModel> model;
  while (const std::optional<ScipAnswer> answer = reader.next()) {
    if (answer->command == "PP") {
      model = scipModel(*answer);
      requireFinite(model->beamSpacing() + model->firstBearing(), "bearings of a scanner");
      requireFinite(model->beamTime(), "time from beam to beam");
      scipScanRequest(*model);
    } else if (model) {
      scipScan(*answer, *model);
    }
  }
}

void checkVelodyne(std::string_view bytes) {
  const VelodynePacket packet(bytes);
  std::vector<CloudPoint> points;
  for (const VelodyneModel& model : velodyneModels()) {
    requireFinite(packetSpan(model, packet.isDual()), "time of a packet");
    for (std::size_t block = 0; block < VelodynePacket::kBlocks; ++block) {
      appendPoints(packet, block, model, {}, 0.0, points);
    }
  }
  for (const CloudPoint& point : points) {
    requireFinite(static_cast<double>(point.x + point.y + point.z + point.time), "a point");
  }
}

/// A signal's definition, and a line of a log after it.
void checkCan(std::string_view bytes) {
  const std::size_t line_end = std::min(bytes.find('\n'), bytes.size());
  const std::string signal_text(bytes.substr(0, line_end));
  const std::string_view log_line = bytes.substr(std::min(line_end + 1, bytes.size()));
  const std::optional<LoggedCanFrame> logged = canLogLine(log_line);
  const CanSignal signal = canSignalFrom("fuzzed", signal_text, "");
  if (logged) {
    requireFinite(logged->time, "time of a frame");
    require(logged->frame.size <= CanFrame::kLongest, "size of a frame");
    requireFinite(signal.value(logged->frame).value_or(0.0), "value of a signal");
  }
}

std::array<InputKind, 8> kinds{
    {{"nmea", checkNmea},
     {"cola_text", [](std::string_view bytes) { checkSick(bytes, ColaDialect::kText); }},
     {"cola_binary", [](std::string_view bytes) { checkSick(bytes, ColaDialect::kBinary); }},
     {"scan_text", [](std::string_view bytes) { checkSickScan(bytes, ColaDialect::kText); }},
     {"scan_binary", [](std::string_view bytes) { checkSickScan(bytes, ColaDialect::kBinary); }},
     {"scip", checkScip},
     {"velodyne", checkVelodyne},
     {"can", checkCan}}};

}  // namespace
}  // namespace datmo::fuzz

extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  return std::atexit([] { datmo::fuzz::printCounts(datmo::fuzz::kinds); });
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return datmo::fuzz::decodeSelected<datmo::DeviceError, datmo::OptionError>(datmo::fuzz::kinds,
                                                                             data, size);
}
