// SPDX-License-Identifier: BSD-3-Clause
// A satellite receiver via TCP and at a serial port, both simulated on this computer.
#include "datmo_fusion/device/nmea_receiver.h"

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "device/device_probe.h"
#include "device/device_reason.h"
#include "device/fake_serial.h"
#include "device/fake_server.h"
#include "device/nmea_sentences.h"
#include <gtest/gtest.h>
#include <termios.h>

#include "datmo_fusion/device/serial_line.h"

namespace datmo::nmea_receiver_test {
namespace {

using samples::DeviceProbe;
using samples::FakeSerial;
using samples::FakeServer;
using samples::ggaLine;
using samples::Measured;
using samples::nmeaLine;
using samples::rmcLine;

const SatelliteFix& fixOf(const Measured& measured) {
  return std::get<SatelliteFix>(measured.data);
}

double speedOf(const Measured& measured) { return std::get<GroundVelocity>(measured.data).speed; }

double seconds(Stamp stamp) {
  return secondsBetween(Stamp::fromSeconds(DeviceProbe::kStart), stamp);
}

class NmeaReceiverTest : public testing::Test {
 protected:
  void connect() {
    fake_.accept();
    fake_.send(nmeaLine("GPTXT,hello"));
    probe_.devices.take();
  }

  void start() {
    probe_.start(fake_.port());
    connect();
  }

  Measured exchange(const std::string& line, double host) {
    probe_.host = host;
    fake_.send(line);
    return probe_.measurements.take();
  }

  FakeServer fake_;
  DeviceProbe probe_{DeviceKind::kNmea};
};

TEST_F(NmeaReceiverTest, PositionsAndVelocitiesOfOneTimeHaveOneStamp) {
  start();
  const Measured fix = exchange(ggaLine(1.0), 5.0);
  EXPECT_NEAR(fixOf(fix).latitude, 45.0 + 10.0 / 60.0, 1e-9);
  EXPECT_NEAR(seconds(fix.stamp), 5.0, 1e-6);
  const Measured velocity = exchange(rmcLine(1.0, 10.0), 5.1);
  EXPECT_NEAR(speedOf(velocity), 5.14444, 1e-4);
  EXPECT_EQ(velocity.stamp, fix.stamp);
  EXPECT_NEAR(seconds(exchange(ggaLine(1.2), 5.2).stamp), 5.2, 1e-6);
}

TEST_F(NmeaReceiverTest, TheReceiversLatencyIsSubtracted) {
  probe_.setup.nmea.delay = 0.08;
  start();
  EXPECT_NEAR(seconds(exchange(ggaLine(1.0), 5.0).stamp), 4.92, 1e-6);
}

TEST_F(NmeaReceiverTest, OneOfTwoVelocitySentencesCounts) {
  start();
  exchange(ggaLine(1.0), 5.0);
  const std::string vtg = nmeaLine("GPVTG,090.0,T,,M,020.0,N,,K");
  EXPECT_NEAR(speedOf(exchange(vtg, 5.0)), 10.28889, 1e-4);
  exchange(rmcLine(1.2, 10.0), 5.2);
  fake_.send(vtg);
  EXPECT_NEAR(speedOf(exchange(rmcLine(1.4, 30.0), 5.4)), 15.4333, 1e-3);
}

TEST_F(NmeaReceiverTest, AVelocityWithoutATimeBelongsToThePositionNearerToIt) {
  start();
  exchange(ggaLine(1.0), 5.0);
  exchange(ggaLine(1.2), 5.2);
  const auto vtg = [](int knots) {
    return nmeaLine("GPVTG,090.0,T,,M," + std::to_string(knots) + ",N,,K");
  };
  const Measured behind = exchange(vtg(10), 5.24);
  EXPECT_NEAR(seconds(behind.stamp), 5.2, 1e-6);
  probe_.host = 5.36;
  fake_.send(vtg(20));
  fake_.send("$GPTXT,broken*00\r\n");
  EXPECT_EQ(probe_.warnings.take(), "bad_sentence");  // all that precedes it is read
  EXPECT_TRUE(probe_.measurements.isEmpty());
  const Measured fix = exchange(ggaLine(1.4), 5.4);
  EXPECT_EQ(fixOf(fix).satellites, 8);
  const Measured ahead = probe_.measurements.take();
  EXPECT_NEAR(speedOf(ahead), 10.28889, 1e-4);
  EXPECT_EQ(ahead.stamp, fix.stamp);
}

TEST_F(NmeaReceiverTest, DriftAndStepsOfTheClockAreFollowed) {
  start();
  constexpr double kDrift = 1e-4;  // of the computer's
  Measured fix;
  double host = 0.0;
  for (int i = 0; i < 600; ++i) {  // two minutes, the network up to 9 ms late
    const double sent = 0.2 * i;
    host = (1.0 + kDrift) * sent;
    fix = exchange(ggaLine(sent), host + 3e-3 * (i % 4));
    if (i > 200) {
      ASSERT_NEAR(seconds(fix.stamp), host, 2e-3);
    }
  }
  EXPECT_NEAR(fix.clock.drift, kDrift, 2e-5);
  fix = exchange(ggaLine(600 * 0.2 + 1.0), host + 0.2);
  EXPECT_EQ(fix.clock.steps, 1U);
  EXPECT_NEAR(seconds(fix.stamp), host + 0.2, 1e-3);
}

TEST_F(NmeaReceiverTest, BadSentencesAreCountedAndThoseWithoutTimeIgnored) {
  start();
  fake_.send("$GPGGA,100001.00,broken*00\r\n");
  EXPECT_EQ(probe_.warnings.take(), "bad_sentence");
  fake_.send(nmeaLine("GPGGA,,,,,,0,00,,,M,,M,,"));
  EXPECT_EQ(probe_.warnings.take(), "no_time");
  fake_.send(nmeaLine("GPGGA,100001.00,9999.0,N,00545.0,E,1,08,1.0,200.0,M,50.0,M,,"));
  EXPECT_EQ(probe_.warnings.take(), "bad_sentence");
  EXPECT_EQ(fixOf(exchange(ggaLine(2.0), 1.0)).satellites, 8);
  fake_.send(ggaLine(1.8));
  EXPECT_EQ(probe_.warnings.take(), "late_sentence");
}

TEST_F(NmeaReceiverTest, DisconnectionsAndOtherDevicesAreReported) {
  start();
  exchange(ggaLine(1.0), 1.0);
  fake_.send("$GPGGA,1000");
  fake_.close();
  EXPECT_EQ(probe_.faults.take(), "lost_connection");
  connect();
  EXPECT_NEAR(seconds(exchange(ggaLine(500.0), 7.0).stamp), 7.0, 1e-6);
  fake_.send(std::string(30000, 'x'));
  EXPECT_EQ(probe_.faults.take(), "bad_sentence");
}

/// A stream of these lines, again and again, until its time has passed: then of positions.
class Repeated : public ByteStream {
 public:
  Repeated(std::string lines, double seconds)
      : lines_(std::move(lines)), end_(Clock::now() + std::chrono::duration<double>(seconds)) {}

  std::string receive() override { return Clock::now() < end_ ? lines_ : ggaLine(1.0); }

 private:
  using Clock = std::chrono::steady_clock;

  std::string lines_;
  std::chrono::time_point<Clock, std::chrono::duration<double>> end_;
};

class TalkingReceiverTest : public testing::Test {
 protected:
  static constexpr double kTimeout = 0.02;       // s
  static constexpr double kLong = 5 * kTimeout;  // s
  static constexpr double kForever = 3600.0;     // s

  /// Reads one measurement from a receiver that sends these lines for a time (s).
  DeviceMeasurement measure(const std::string& lines, double seconds) {
    const StreamOpener open = [&] { return std::make_unique<Repeated>(lines, seconds); };
    NmeaReceiver receiver(open, NmeaOptions(), kTimeout,
                          {stop_, clock_, [](const DeviceError& /*warning*/) {}});
    receiver.connect();
    return receiver.next();
  }

 private:
  std::atomic<bool> stop_{false};
  DeviceClock clock_{ClockOptions(), [] { return Stamp::fromSeconds(DeviceProbe::kStart); }};
};

TEST_F(TalkingReceiverTest, OneThatSendsNoPositionsIsReported) {
  const std::string vtg = nmeaLine("GPVTG,090.0,T,,M,020.0,N,,K");
  EXPECT_EQ(samples::reasonOf([&] { measure(nmeaLine("GPTXT,hello") + vtg, kForever); }),
            "no_positions");
}

TEST_F(TalkingReceiverTest, OneThatHasNoSatellitesYetIsWaitedFor) {
  const DeviceMeasurement first = measure(nmeaLine("GPGGA,,,,,,0,00,,,M,,M,,"), kLong);
  EXPECT_TRUE(std::holds_alternative<SatelliteFix>(first.data));
}

TEST(SerialReceiverTest, AReceiverAtASerialPortIsReadAndItsEndIsReported) {
  DeviceProbe probe(DeviceKind::kNmea);
  auto serial = std::make_unique<FakeSerial>();
  probe.setup.address = serial->file();
  probe.setup.nmea.baud = 115200;
  serial->send(nmeaLine("GPTXT,hello") + ggaLine(1.0));
  probe.start(0);
  EXPECT_EQ(fixOf(probe.measurements.take()).satellites, 8);
  EXPECT_EQ(serial->speed(), static_cast<speed_t>(B115200));
  serial.reset();
  EXPECT_EQ(probe.faults.take(), "lost_connection");
  EXPECT_EQ(probe.faults.take(), "no_connection");
}

TEST(SerialReceiverTest, AnUnsupportedBaudRateIsReported) {
  const FakeSerial serial;
  const std::atomic<bool> stop{false};
  EXPECT_THROW(SerialLine({serial.file(), 12345, 1.0, false}, stop), DeviceError);
}

}  // namespace
}  // namespace datmo::nmea_receiver_test
