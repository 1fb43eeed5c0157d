// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/wire/station_messages.h"

#include "decoded_state.h"

namespace datmo {

void StationMessageOptions::visit(OptionVisitor& visitor) {
  visitor.integer({"leap_seconds", "s",
                   "leap seconds since 2004, which times on the wire include and UTC does not "
                   "(IERS Bulletin C)"},
                  leap_seconds, {0.0, 60.0});
  visitor.choice(
      {"dictionary", "",
       "version of ETSI TS 102 894-2 of the CPMs sent and received: 2.1.1, or 2.2.1 and later"},
      dictionary,
      Choices<ItsDictionary>{{"2.1.1", ItsDictionary::k211}, {"2.2.1", ItsDictionary::k221}});
  visitor.number({"position_sigma", "m",
                  "standard deviation along each axis of a station's position whose confidence it "
                  "does not report: that of satellites without corrections"},
                 position_sigma, {0.01, 100.0});
  visitor.number({"object_position_sigma", "m", "the same for an object relative to the station"},
                 object_position_sigma, {0.01, 100.0});
  visitor.number({"speed_sigma", "m/s", "the same for a speed"}, speed_sigma, {0.01, 20.0});
  visitor.number({"heading_sigma", "rad", "the same for a heading or course"}, heading_sigma,
                 {0.001, 1.5});
  visitor.number({"unknown_speed_sigma", "m/s",
                  "standard deviation of the velocity along each axis, if no speed is reported"},
                 unknown_speed_sigma, {0.1, 100.0});
  visitor.number(
      {"existence", "1", "existence probability of an object whose message has no quality"},
      existence, {0.0, 1.0});
}

StationMessage decodeStation(std::string_view bytes, Stamp now,
                             const StationMessageOptions& options) {
  UperReader head(bytes);
  ItsHeader header;
  walk(head, header);
  return header.message == ItsHeader::kCam ? decode(decodeCam(bytes), now, options)
                                           : decode(decodeCpm(bytes, options.dictionary), options);
}

}  // namespace datmo
