// SPDX-License-Identifier: BSD-3-Clause
// Writes seeds from the samples of the unit tests: fuzz_test_seeds FOLDER (test/fuzz/corpus). The
// first byte of each but those for stages selects the decoder, as in fuzz_device.cpp,
// fuzz_files.cpp and fuzz_wire.cpp.
#include <filesystem>
#include <fstream>
#include <iostream>

#include "device/nmea_sentences.h"
#include "device/velodyne_packets.h"
#include "file_seeds.h"
#include "fusion/complete_signal_messages.h"
#include "fusion/wire_messages.h"
#include "stage_seeds.h"

#include <ros/console.h>
#include <ros/time.h>

#include "datmo_fusion/device/cola.h"
#include "datmo_fusion/device/scip.h"

namespace datmo {
namespace {

void write(const std::string& name, const std::string& bytes) {
  std::filesystem::create_directories(std::filesystem::path(name).parent_path());
  std::ofstream stream(name + ".bin", std::ios::binary);
  stream << bytes;
  if (!stream.flush()) {
    throw std::runtime_error(name + ".bin cannot be written");
  }
}

void write(const std::string& name, unsigned selected, const std::string& bytes) {
  write(name, static_cast<char>(selected) + bytes);
}

/// Returns lines with their checksums, as a scanner sends them.
std::string scipAnswer(const std::string& command, const std::string& status,
                       const std::vector<std::string>& lines) {
  std::string text = command + "\n" + status + scipChecksum(status) + "\n";
  for (const std::string& line : lines) {
    text += line + scipChecksum(line) + "\n";
  }
  return text + "\n";
}

void writeDevice(const std::string& folder) {
  const std::string text_scan =
      "sSN LMDscandata 1 1 A037B9 0 0 8 1 F4240 F9060 0 0 7 0 0 9C4 168 0 1 "
      "DIST1 3F800000 0 FFF92230 1388 2 3E8 7D0 0 0 0 0 0 0";
  const auto scan_bytes = [] {
    static constexpr char kFields[] =
        "\0\x01\0\x01\0\xA0\x37\xB9\0\0\0\x08\0\x01\0\x0F\x42\x40\0\x0F\x90\x60\0\0\x07\0\0\0\0\0"
        "\x09\xC4\0\0\x01\x68\0\0\0\x01"
        "DIST1\x3F\x80\0\0\0\0\0\0\xFF\xF9\x22\x30\x13\x88\0\x01\x03\xE8\0\0\0\0\0\0\0\0\0\0\0\0";
    return "sSN LMDscandata " + std::string(kFields, sizeof kFields - 1);
  }();
  write(folder + "/nmea", 0, samples::ggaLine(1.0) + samples::rmcLine(1.0, 5.0));
  write(folder + "/cola_text", 1, colaFrame({ColaDialect::kText, text_scan}));
  write(folder + "/cola_ident", 1,
        colaFrame({ColaDialect::kText, "sRA DeviceIdent 6 LMS111 4 V1.1"}));
  write(folder + "/cola_binary", 2, colaFrame({ColaDialect::kBinary, scan_bytes}));
  write(folder + "/scan_text", 3, text_scan);
  write(folder + "/scan_binary", 4, scan_bytes);
  const std::vector<std::string> model{"MODL:UST-10LX;", "DMIN:20;", "DMAX:30000;", "ARES:16;",
                                       "AMIN:6;",        "AMAX:10;", "AFRT:8;",     "SCAN:2400;"};
  write(folder + "/scip", 5,
        scipAnswer("PP", "00", model) +
            scipAnswer("MD0006001001000", "99", {"0000", "0CB0CB0CB0CB0CB"}));
  write(folder + "/velodyne", 6, samples::VelodyneSample{}.bytes());
  write(folder + "/can", 7,
        "0x1A0 8|16@1+ (0.01,0) [0|250] \"km/h\"\n(1436509052.249713) can0 1A0#2A366C2B");
}

void writeWire(const std::string& folder) {
  write(folder + "/cpm", 0, samples::wireCpm().bytes());
  write(folder + "/cpm_rich", 0, samples::wireRichCpm(false).bytes());
  write(folder + "/cpm_older", 1, samples::wireRichCpm(true).bytes());
  write(folder + "/cam", 2, samples::wireCam().bytes());
  write(folder + "/cam_station", 0, samples::wireCam().bytes());
  write(folder + "/spatem", 3, samples::spatemWithAll().bytes());
  write(folder + "/mapem", 4, samples::mapemWithAll().bytes());
}

void writeFiles(const std::string& folder) {
  for (const fuzz::FileSeed& seed : fuzz::fileSeeds()) {
    write(folder + "/" + seed.name, seed.decoder, seed.bytes);
  }
}

void writeStages(const std::string& folder) {
  ros::Time::init();
  ros::console::set_logger_level(ROSCONSOLE_DEFAULT_NAME, ros::console::levels::Error);
  for (const fuzz::StageSeed& seed : fuzz::stageSeeds()) {
    write(folder + "/" + seed.name, encode(seed.drive));
  }
}

}  // namespace
}  // namespace datmo

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: fuzz_test_seeds FOLDER\n";
    return 2;
  }
  try {
    datmo::writeDevice(std::string(argv[1]) + "/device");
    datmo::writeWire(std::string(argv[1]) + "/wire");
    datmo::writeFiles(std::string(argv[1]) + "/files");
    datmo::writeStages(std::string(argv[1]) + "/stages");
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
