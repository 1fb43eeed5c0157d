// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/device_setup.h"

#include <memory>
#include <optional>

#include "datmo_fusion/device/can_log.h"
#include "datmo_fusion/device/can_socket.h"
#include "datmo_fusion/device/can_vehicle.h"
#include "datmo_fusion/device/capture_file.h"
#include "datmo_fusion/device/datagram_socket.h"
#include "datmo_fusion/device/sick_scanner.h"
#include "datmo_fusion/device/stream_opener.h"

namespace datmo {

namespace {

DeviceAddress addressOf(const DeviceSetup& setup, int usual_port) {
  return {setup.address, setup.port == 0 ? usual_port : setup.port, setup.timeout};
}

DeviceMaker hokuyoMaker(const DeviceSetup& setup) {
  const DeviceAddress address = addressOf(setup, HokuyoScanner::kPort);
  return [address, options = setup.hokuyo](const DeviceHost& host) {
    return std::make_unique<HokuyoScanner>(address, options, host);
  };
}

DeviceMaker sickMaker(const DeviceSetup& setup) {
  return [address = addressOf(setup, SickScanner::kPort),
          dialect = std::make_shared<ColaDialect>(ColaDialect::kBinary)](const DeviceHost& host) {
    return std::make_unique<SickScanner>(address, dialect, host);
  };
}

DeviceMaker velodyneMaker(const DeviceSetup& setup) {
  const DeviceAddress address = addressOf(setup, VelodyneLidar::kPort);
  return [address, recording = setup.recording, options = setup.velodyne](const DeviceHost& host) {
    const PacketOpener open = [=, &stop = host.stop]() -> std::unique_ptr<PacketSource> {
      if (recording.empty()) {
        return std::make_unique<DatagramSocket>(address, stop);
      }
      return std::make_unique<CaptureFile>(recording, address.port, stop);
    };
    return std::make_unique<VelodyneLidar>(open, options, host);
  };
}

DeviceMaker nmeaMaker(const DeviceSetup& setup) {
  const DeviceAddress address = addressOf(setup, NmeaReceiver::kPort);
  return [address, options = setup.nmea](const DeviceHost& host) {
    const StreamOpener open = [=, &stop = host.stop] {
      return openStream(address, options.baud, false, stop);
    };
    return std::make_unique<NmeaReceiver>(open, options, address.timeout, host);
  };
}

DeviceMaker canMaker(const DeviceSetup& setup) {
  return [bus = setup.address, recording = setup.recording, timeout = setup.timeout,
          options = setup.can](const DeviceHost& host) {
    const bool is_played = !recording.empty();
    const CanOpener open = [=, &stop = host.stop]() -> std::unique_ptr<CanSource> {
      if (is_played) {
        return std::make_unique<CanLog>(recording, bus, stop);
      }
      return CanSocket::open(bus, timeout, stop);
    };
    return std::make_unique<CanVehicle>(open, options, is_played ? recording : bus,
                                        is_played ? std::nullopt : std::optional<double>(timeout),
                                        host);
  };
}

}  // namespace

void DeviceSetup::visit(OptionVisitor& visitor) {
  constexpr double kPorts = 65535.0;
  visitor.choice({"kind", "", "protocol of the device"}, kind,
                 Choices<DeviceKind>{{"hokuyo", DeviceKind::kHokuyo},
                                     {"sick_lms", DeviceKind::kSickLms},
                                     {"velodyne", DeviceKind::kVelodyne},
                                     {"nmea", DeviceKind::kNmea},
                                     {"can", DeviceKind::kCan}});
  visitor.text({"address", "",
                "host name or address of the device; velodyne: empty for any sender; hokuyo, nmea: "
                "or the file of a serial port; can: the interface, can0"},
               address, {});
  visitor.integer(
      {"port", "1", "port of the device; 0: its make's default (10940, 2111, 2368, 10110)"}, port,
      {0.0, kPorts});
  visitor.number({"timeout", "s", "a device that is silent for longer is reconnected"}, timeout,
                 {0.05, 60.0});
  visitor.text(
      {"recording", "",
       "velodyne: a capture file (pcap) to play instead; can: a log of candump -L to play, the "
       "frames of `address`, or all if that is empty; empty: the network, the bus"},
      recording, {});
  runner.visit(visitor);
  visitor.group("hokuyo", [&] { hokuyo.visit(visitor); });
  visitor.group("velodyne", [&] { velodyne.visit(visitor); });
  visitor.group("nmea", [&] { nmea.visit(visitor); });
  visitor.group("can", [&] { can.visit(visitor); });
}

void DeviceSetup::check() const {
  if (kind == DeviceKind::kCan) {
    CanMotion(can, [](const DeviceError& /*error*/) {});
  }
}

DeviceMaker deviceMaker(const Checked<DeviceSetup>& setup) {
  switch (setup->kind) {
    case DeviceKind::kSickLms:
      return sickMaker(*setup);
    case DeviceKind::kVelodyne:
      return velodyneMaker(*setup);
    case DeviceKind::kNmea:
      return nmeaMaker(*setup);
    case DeviceKind::kCan:
      return canMaker(*setup);
    case DeviceKind::kHokuyo:
      break;
  }
  return hokuyoMaker(*setup);
}

}  // namespace datmo
