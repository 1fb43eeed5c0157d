// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <string>

#include "datmo_fusion/device/nmea.h"

namespace datmo::samples {

/// Returns a sentence as it is on the wire; `text`: between $ and *.
inline std::string nmeaLine(const std::string& text) {
  char checksum[3];
  std::snprintf(checksum, sizeof checksum, "%02X", nmeaChecksum(text));
  return "$" + text + "*" + checksum + "\r\n";
}

/// Returns the time of day from seconds after 10 o'clock.
inline std::string nmeaClock(double seconds) {
  const int whole = static_cast<int>(seconds);
  char text[20];
  std::snprintf(text, sizeof text, "10%02d%02d.%03d", whole / 60 % 60, whole % 60,
                static_cast<int>((seconds - whole) * 1e3 + 0.5));
  return text;
}

inline std::string ggaLine(double seconds) {
  return nmeaLine("GPGGA," + nmeaClock(seconds) +
                  ",4510.0000,N,00545.0000,E,1,08,1.0,200.0,M,50.0,M,,");
}

inline std::string rmcLine(double seconds, double knots) {
  return nmeaLine("GPRMC," + nmeaClock(seconds) + ",A,4510.0000,N,00545.0000,E," +
                  std::to_string(knots) + ",090.0,010126,,,A");
}

}  // namespace datmo::samples
