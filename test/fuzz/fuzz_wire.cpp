// SPDX-License-Identifier: BSD-3-Clause
// What other stations and traffic lights send: CAM, CPM, SPATEM, MAPEM.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "fuzz_check.h"

#include "datmo_fusion/fusion/wire/cam.h"
#include "datmo_fusion/fusion/wire/mapem.h"
#include "datmo_fusion/fusion/wire/spatem.h"
#include "datmo_fusion/fusion/wire/station_messages.h"
#include "datmo_fusion/fusion/wire/wire_error.h"

namespace datmo::fuzz {
namespace {

const Stamp kNow = Stamp::fromSeconds(1772366400.0);  // 2026-03-01 12:00:00 UTC

void checkStation(std::string_view bytes, ItsDictionary dictionary) {
  StationMessageOptions options;
  options.dictionary = dictionary;
  const StationMessage message = decodeStation(bytes, kNow, options);
  require(isValid(message.plane.datum()), "a station that is not on the earth");
  for (const StationTrack& track : message.list.tracks) {
    require(track.position.allFinite() && track.velocity.allFinite(), "state of a track");
    require(track.covariance.allFinite(), "covariance of a track");
    require((track.covariance.diagonal().array() > 0.0).all(), "variance of a track");
    require(std::isfinite(track.heading) && track.heading_variance > 0.0, "heading of a track");
    requireFinite(track.length + track.width + track.height, "size of a track");
    requireFinite(track.existence_probability, "existence of a track");
  }
}

/// A message that was decoded and encoded again is decoded without an error to the same bytes.
template <typename Decode>
void checkRoundTrip(std::string_view bytes, const Decode& decode) {
  const std::string encoded = encode(decode(bytes));
  require(encode(decode(encoded)) == encoded, "an encoded message");
}

std::array<InputKind, 5> kinds{
    {{"station", [](std::string_view bytes) { checkStation(bytes, ItsDictionary::k221); }},
     {"station_older", [](std::string_view bytes) { checkStation(bytes, ItsDictionary::k211); }},
     {"cam", [](std::string_view bytes) { checkRoundTrip(bytes, decodeCam); }},
     {"spatem", [](std::string_view bytes) { checkRoundTrip(bytes, decodeSpatem); }},
     {"mapem", [](std::string_view bytes) { checkRoundTrip(bytes, decodeMapem); }}}};

}  // namespace
}  // namespace datmo::fuzz

extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  return std::atexit([] { datmo::fuzz::printCounts(datmo::fuzz::kinds); });
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return datmo::fuzz::decodeSelected<datmo::WireError>(datmo::fuzz::kinds, data, size);
}
