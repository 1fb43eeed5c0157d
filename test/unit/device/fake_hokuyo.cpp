// SPDX-License-Identifier: BSD-3-Clause
#include "device/fake_hokuyo.h"

#include "datmo_fusion/device/scip.h"

namespace datmo::samples {

namespace {

constexpr std::size_t kLineLength = 64;

std::string encoded(std::uint32_t value, int characters) {
  std::string text;
  for (int i = characters - 1; i >= 0; --i) {
    text += static_cast<char>(((value >> (6 * i)) & 0x3FU) + '0');
  }
  return text;
}

std::string checked(const std::string& line) { return line + scipChecksum(line) + "\n"; }

}  // namespace

const std::vector<std::string> FakeHokuyo::kModel{"MODL:UST-10LX", "DMIN:20",  "DMAX:30000",
                                                  "ARES:16",       "AMIN:6",   "AMAX:10",
                                                  "AFRT:8",        "SCAN:2400"};

void FakeHokuyo::shakeHands(const std::vector<std::string>& model) {
  for (std::string asked = command(); !asked.empty(); asked = command()) {
    answer(asked, "00", asked == "PP" ? model : std::vector<std::string>());
    if (asked.rfind("MD", 0) == 0) {
      return;
    }
  }
}

std::string FakeHokuyo::answerText(const std::string& command, const std::string& status,
                                   const std::vector<std::string>& lines) {
  std::string text = command + "\n" + checked(status);
  for (const std::string& line : lines) {
    text += line + ";" + scipChecksum(line) + "\n";
  }
  return text + "\n";
}

std::string FakeHokuyo::scan(std::uint32_t clock, const std::vector<std::uint32_t>& ranges) {
  std::string text = "MD0006001001000\n" + checked("99") + checked(encoded(clock, 4));
  std::string data;
  for (const std::uint32_t range : ranges) {
    data += encoded(range, 3);
  }
  for (std::size_t i = 0; i < data.size(); i += kLineLength) {
    text += checked(data.substr(i, kLineLength));
  }
  return text + "\n";
}

}  // namespace datmo::samples
