// SPDX-License-Identifier: BSD-3-Clause
#include "device/fake_sick.h"

#include <cstdio>
#include <map>

#include "datmo_fusion/device/cola.h"

namespace datmo::samples {

namespace {

std::string hexadecimal(std::uint64_t value) {
  char text[20];
  std::snprintf(text, sizeof text, "%llX", static_cast<unsigned long long>(value));
  return text;
}

std::string channel(const std::string& head, const std::vector<std::uint32_t>& values) {
  std::string text = " " + head + " 1388 " + hexadecimal(values.size());
  for (const std::uint32_t value : values) {
    text += " " + hexadecimal(value);
  }
  return text;
}

}  // namespace

std::string SickTelegram::text() const {
  const std::string channels = intensities.empty() ? "1" : "2";
  std::string text = "sSN LMDscandata 1 1 A037B9 " + state + " " + hexadecimal(counter + 7U) + " " +
                     hexadecimal(counter) + " " + hexadecimal(begun) + " " + hexadecimal(sent) +
                     " 0 0 7 0 0 9C4 168 0 " + channels +
                     channel("DIST1 " + factor + " 00000000 " + first_angle, ranges);
  if (!intensities.empty()) {
    text += channel("RSSI1 3F800000 00000000 " + first_angle, intensities);
  }
  return text + " 0 0 0 0 0 0";
}

std::string FakeSick::goodAnswer(const std::string& command, const std::string& name) {
  const std::map<std::string, std::string> answers{
      {"sRN DeviceIdent",
       "sRA DeviceIdent " + hexadecimal(name.size()) + " " + name + " 10 V1.36-21.10.2010"},
      {"sMN SetAccessMode 03 F4724744", "sAN SetAccessMode 1"},
      {"sWN LMDscandatacfg 01 00 1 1 0 00 00 0 0 0 0 +1", "sWA LMDscandatacfg"},
      {"sMN LMCstartmeas", "sAN LMCstartmeas 0"},
      {"sMN Run", "sAN Run 1"},
      {"sEN LMDscandata 1", "sEA LMDscandata 1"}};
  const auto answer = answers.find(command);
  return answer == answers.end() ? "sFA 2" : answer->second;
}

void FakeSick::shakeHands(const std::string& name) {
  for (std::string asked = command(); !asked.empty(); asked = command()) {
    answer(goodAnswer(asked, name));
    if (asked == "sEN LMDscandata 1") {
      return;
    }
  }
}

std::string FakeSick::command() {
  const std::string received = receive('\x03');
  return received.empty() ? "" : received.substr(1);
}

void FakeSick::answer(const std::string& text) const { send(colaTelegram(text)); }

}  // namespace datmo::samples
