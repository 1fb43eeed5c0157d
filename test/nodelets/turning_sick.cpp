// SPDX-License-Identifier: BSD-3-Clause
#include "turning_sick.h"

#include <chrono>
#include <cmath>
#include <utility>

namespace datmo {

namespace {

constexpr double kFrequencyUnit = 0.01;  // Hz
constexpr double kMicroseconds = 1e6;
constexpr float kMillimeters = 1e3F;
constexpr float kLmsRange = 50.0F;           // m
constexpr double kTurnDegrees = 360.0;       // deg
constexpr std::uint32_t kDigit = 1U << 16U;  // of a number in remissions

/// That of a SickTelegram.
constexpr Sweep kLmsSweep{-135.0, 0.5, 541, 0.0};

}  // namespace

TurningSick::TurningSick(int port, double rate)
    : device_(port),
      frequency_(static_cast<std::uint32_t>(std::lround(rate / kFrequencyUnit))),
      sweep_(kLmsSweep) {
  sweep_.beam_time = sweep_.beam_spacing / (kTurnDegrees * kFrequencyUnit * frequency_);
}

TurningSick::~TurningSick() { stop(); }

void TurningSick::connect() {
  device_.accept();
  device_.shakeHands("LMS15x_FieldEval");
}

void TurningSick::begin(std::function<double()> now) {
  now_ = std::move(now);
  thread_ = std::thread([this] { turn(); });
}

void TurningSick::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  stopped_.notify_all();
  if (thread_.joinable()) {
    thread_.join();
  }
}

std::vector<ros::SteadyTime> TurningSick::departures() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return departures_;
}

std::size_t TurningSick::numberOf(const sensor_msgs::LaserScan& scan) {
  return static_cast<std::size_t>(scan.intensities.at(0)) +
         kDigit * static_cast<std::size_t>(scan.intensities.at(1));
}

void TurningSick::turn() {
  const double begin = now_();
  const double period = 1.0 / (kFrequencyUnit * frequency_);
  const double sweep_time = sweep_.beam_time * (sweep_.beams - 1);
  while (true) {
    const double begun = begin + period * scans_;
    // The world is known in advance, so that computing it delays no scan.
    const samples::SickTelegram telegram = telegramAt(begun);
    const auto bytes = colaFrame(telegram.in(device_.dialect));
    std::unique_lock<std::mutex> lock(mutex_);
    const std::chrono::duration<double> left(begun + sweep_time - now_());
    if (stopped_.wait_for(lock, left, [this] { return stop_; })) {
      return;
    }
    departures_.push_back(ros::SteadyTime::now());
    lock.unlock();
    device_.send(bytes);
    ++scans_;
  }
}

samples::SickTelegram TurningSick::telegramAt(double seconds) const {
  samples::SickTelegram telegram;
  const auto microseconds = static_cast<std::uint64_t>(std::llround(kMicroseconds * seconds));
  telegram.begun = static_cast<std::uint32_t>(microseconds);
  telegram.sent = telegram.begun + static_cast<std::uint32_t>(std::lround(
                                       kMicroseconds * sweep_.beam_time * (sweep_.beams - 1)));
  telegram.counter = static_cast<std::uint16_t>(scans_);
  telegram.frequency = frequency_;
  telegram.ranges.clear();
  for (const float range : world_.ranges(seconds, sweep_)) {
    const bool is_seen = range < kLmsRange;
    telegram.ranges.push_back(
        is_seen ? static_cast<std::uint32_t>(std::lround(kMillimeters * range)) : 0);
  }
  telegram.intensities.assign(telegram.ranges.size(), 0);
  telegram.intensities[0] = scans_ % kDigit;
  telegram.intensities[1] = scans_ / kDigit;
  return telegram;
}

}  // namespace datmo
