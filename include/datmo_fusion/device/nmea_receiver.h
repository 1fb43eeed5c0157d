// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

/// A satellite receiver that speaks NMEA 0183: positions of GGA, velocities of RMC, or of VTG where
/// there is no RMC. Sentences carry the time of the measurement, which they all have in common; the
/// first of them to arrive tells the receiver's clock. A VTG, which has none, belongs to the GGA
/// nearer to it in time of arrival, and waits for it if that is the next one.
class NmeaReceiver : public Device {
 public:
  static constexpr int kPort = 10110;  ///< of NMEA 0183 over TCP (IANA)

  NmeaReceiver(StreamOpener open, const NmeaOptions& options, const DeviceHost& host);

  /// Connected by the first sentence.
  std::string connect() override;
  DeviceMeasurement next() override;

 private:
  /// Sentences that are none are counted; many in a row are no receiver's.
  NmeaSentence nextSentence();
  /// What a sentence says; none: nothing that is published.
  std::optional<DeviceMeasurement> measurementOf(const NmeaSentence& sentence);
  /// Whether it is of the newest time, which it may bring.
  bool takeTime(const std::string& field);
  /// Whether a sentence that arrives now is nearer to the next time than to the newest one.
  bool isOfNextTime() const;

  StreamOpener open_;
  NmeaOptions options_;
  DeviceHost host_;
  std::unique_ptr<ByteStream> stream_;
  NmeaReader reader_;
  Stamp stamp_;                                     ///< of the newest time
  Stamp arrival_;                                   ///< of its first sentence
  std::optional<GroundVelocity> waiting_velocity_;  ///< of the next time
  std::optional<DeviceMeasurement> pending_;        ///< after what was returned
  bool has_time_ = false;                           ///< of this connection
  bool has_rmc_ = false;                            ///< the same
};

}  // namespace datmo
