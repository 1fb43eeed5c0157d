// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/device/byte_stream.h"
#include "datmo_fusion/device/device.h"
#include "datmo_fusion/device/nmea.h"

namespace datmo {

struct NmeaOptions {
  int baud = 9600;     ///< bits per second
  double delay = 0.0;  ///< s
  double sigma = 4.0;  ///< m

  void visit(OptionVisitor& visitor);
};

/// Throws DeviceError.
using StreamOpener = std::function<std::unique_ptr<ByteStream>()>;

/// A satellite receiver that speaks NMEA 0183: positions from GGA, velocities from RMC, or from VTG
/// if there is no RMC. All sentences of a measurement carry its time; the first of them to arrive
/// is used to estimate the receiver's clock. A VTG, which has no time, belongs to the GGA closer to
/// it in arrival time, and waits for it if that is the next one.
class NmeaReceiver : public Device {
 public:
  static constexpr int kPort = 10110;  ///< default of NMEA 0183 over TCP (IANA)

  /// `timeout`: s; after twice this time without a GGA or RMC it is not a receiver, or not set up
  /// (next() throws DeviceError, `no_positions`).
  NmeaReceiver(StreamOpener open, const NmeaOptions& options, double timeout,
               const DeviceHost& host);

  /// Returns after the first sentence.
  std::string connect() override;
  DeviceMeasurement next() override;

 private:
  using Clock = std::chrono::steady_clock;

  /// Returns the next valid sentence. Invalid ones are counted; many in a row are an error: the
  /// device is not a receiver.
  NmeaSentence nextSentence();
  /// Returns the measurement in a sentence; none if it has nothing to publish.
  std::optional<DeviceMeasurement> measurementOf(const NmeaSentence& sentence);
  /// Throws DeviceError if sentences with positions or velocities have been missing for too long.
  void checkHasPositions(const NmeaSentence& sentence);
  /// Updates the newest time, and returns whether the sentence belongs to it.
  bool readTime(const std::string& field);
  /// Returns whether a sentence that arrives now is closer to the next time than to the newest one.
  bool isOfNextTime() const;

  StreamOpener open_;
  NmeaOptions options_;
  double timeout_;  ///< s
  DeviceHost host_;
  std::unique_ptr<ByteStream> stream_;
  NmeaReader reader_;
  Stamp stamp_;                                     ///< of the newest time
  Stamp arrival_;                                   ///< of its first sentence
  std::optional<GroundVelocity> waiting_velocity_;  ///< of the next time
  std::optional<DeviceMeasurement> pending_;        ///< to be returned next
  bool has_time_ = false;                           ///< of this connection
  bool has_rmc_ = false;                            ///< the same
  Clock::time_point last_timed_;                    ///< arrival of the last GGA or RMC
};

}  // namespace datmo
