// SPDX-License-Identifier: BSD-3-Clause
#include "device/fake_sick.h"

#include <cstdio>
#include <map>

#include <gtest/gtest.h>

namespace datmo::samples {

namespace {

std::string hexadecimal(std::uint64_t value) {
  char text[20];
  std::snprintf(text, sizeof text, "%llX", static_cast<unsigned long long>(value));
  return text;
}

/// Fields in the order of a telegram.
class Fields {
 public:
  Fields(ColaDialect dialect, const std::string& name)
      : is_binary_(dialect == ColaDialect::kBinary), bytes_(name + (is_binary_ ? " " : "")) {}

  Fields& add(std::uint32_t value, unsigned size) {
    if (!is_binary_) {
      bytes_ += " " + hexadecimal(value);
    }
    for (unsigned left = is_binary_ ? size : 0; left > 0; --left) {
      bytes_ += static_cast<char>(value >> (8 * (left - 1)));
    }
    return *this;
  }

  Fields& add(const std::string& text) {
    bytes_ += (is_binary_ ? "" : " ") + text;
    return *this;
  }

  Fields& addChannel(const std::string& name, std::uint32_t factor, std::uint32_t first_angle,
                     const std::vector<std::uint32_t>& values) {
    add(name).add(factor, 4).add(0, 4).add(first_angle, 4).add(5000, 2);
    add(static_cast<std::uint32_t>(values.size()), 2);
    for (const std::uint32_t value : values) {
      add(value, 2);
    }
    return *this;
  }

  const std::string& bytes() const { return bytes_; }

 private:
  bool is_binary_;
  std::string bytes_;
};

}  // namespace

ColaTelegram SickTelegram::in(ColaDialect dialect) const {
  Fields fields(dialect, "sSN LMDscandata");
  fields.add(1, 2).add(1, 2).add(0xA037B9, 4).add(0, 1).add(state, 1);
  fields.add(counter + 7U, 2).add(counter, 2).add(begun, 4).add(sent, 4);
  fields.add(0, 1).add(0, 1).add(7, 1).add(0, 1).add(0, 2);
  fields.add(frequency, 4).add(360, 4);  // of scans and beams
  fields.add(0, 2);                      // encoders
  fields.add(intensities.empty() ? 1 : 2, 2).addChannel("DIST1", factor, first_angle, ranges);
  if (!intensities.empty()) {
    fields.addChannel("RSSI1", 0x3F800000, first_angle, intensities);
  }
  // Channels of 8 bits, position, name, comment, time, event.
  fields.add(0, 2).add(0, 2).add(0, 2).add(0, 2).add(0, 2).add(0, 2);
  return {dialect, fields.bytes()};
}

std::string FakeSick::goodAnswer(const std::string& command, const std::string& name) const {
  const auto length = static_cast<std::uint32_t>(name.size());
  const std::string identity =
      Fields(dialect, "sRA DeviceIdent").add(length, 2).add(name).add(16, 2).bytes() +
      (dialect == ColaDialect::kText ? " " : "") + "V1.36-21.10.2010";
  const std::map<std::string, std::string> text{
      {"sRN DeviceIdent", identity},
      {"sMN SetAccessMode 03 F4724744", "sAN SetAccessMode 1"},
      {"sWN LMDscandatacfg 01 00 1 1 0 00 00 0 0 0 0 +1", "sWA LMDscandatacfg"},
      {"sMN LMCstartmeas", "sAN LMCstartmeas 0"},
      {"sMN Run", "sAN Run 1"},
      {"sEN LMDscandata 1", "sEA LMDscandata 1"}};
  const std::map<std::string, std::string> binary{
      {"sRN DeviceIdent", identity},
      {bytesOf("sMN SetAccessMode \x03\xF4\x72\x47\x44"), bytesOf("sAN SetAccessMode \x01")},
      {bytesOf("sWN LMDscandatacfg \x01\0\x01\x01\0\0\0\0\0\0\0\0\x01"), "sWA LMDscandatacfg "},
      {"sMN LMCstartmeas", bytesOf("sAN LMCstartmeas \0")},
      {"sMN Run", bytesOf("sAN Run \x01")},
      {bytesOf("sEN LMDscandata \x01"), bytesOf("sEA LMDscandata \x01")}};
  const auto& answers = dialect == ColaDialect::kBinary ? binary : text;
  const auto answer = answers.find(command);
  return answer == answers.end() ? "sFA 2" : answer->second;
}

void FakeSick::shakeHands(const std::string& name) {
  for (std::string asked = command(); !asked.empty(); asked = command()) {
    answer(goodAnswer(asked, name));
    if (asked.rfind("sEN LMDscandata", 0) == 0) {
      return;
    }
  }
}

ColaTelegram FakeSick::anyCommand() {
  const std::string start = receiveBytes(2);
  if (start != "\x02\x02") {
    const std::string rest = start.empty() ? "" : receive('\x03');
    return {ColaDialect::kText, rest.empty() ? "" : start.substr(1) + rest};
  }
  EXPECT_EQ(receiveBytes(5), bytesOf("\x02\x02\0\0\0"));
  const std::size_t length = static_cast<unsigned char>(receiveBytes(1)[0]);
  const std::string bytes = receiveBytes(length);
  char sum = receiveBytes(1)[0];
  for (const char byte : bytes) {
    sum = static_cast<char>(sum ^ byte);
  }
  EXPECT_EQ(sum, 0) << bytes;
  return {ColaDialect::kBinary, bytes};
}

std::string FakeSick::command() {
  ColaTelegram asked = anyCommand();
  if (!asked.bytes.empty() && asked.dialect != dialect) {
    if (other == OtherDialect::kRefuses) {
      answer("sFA 2");
    }
    if (other != OtherDialect::kHangsUp) {
      EXPECT_EQ(receiveBytes(1), "");  // until the peer has closed the connection
    }
    accept();
    asked = anyCommand();
    EXPECT_EQ(asked.dialect, dialect);
  }
  return asked.bytes;
}

}  // namespace datmo::samples
