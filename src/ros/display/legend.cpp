// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/display/legend.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <boost/make_shared.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <sensor_msgs/image_encodings.h>

#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/display/marker_colors.h"

namespace datmo {

namespace {

// px
constexpr int kRowHeight = 26;
constexpr int kWidth = 300;
constexpr int kIconWidth = 60;
constexpr int kTextInset = 9;  // above the bottom of a row
constexpr int kMiddle = kIconWidth / 2;
constexpr int kCenter = kRowHeight / 2;
constexpr int kGround = kRowHeight - 3;

constexpr double kTextScale = 0.5;  // of OpenCV's font, which is 22 px high
constexpr double kFullChannel = 255.0;

const cv::Scalar kBackground(226, 230, 232);
const cv::Scalar kText(20, 22, 26);
const cv::Scalar kTruth(64, 64, 64);
const cv::Scalar kLine(30, 40, 70);

cv::Scalar toScalar(const std_msgs::ColorRGBA& color) {
  return kFullChannel * cv::Scalar(color.r, color.g, color.b);
}

/// One entry of the legend: a picture in a rectangle of kIconWidth x kRowHeight, and its text.
struct Entry {
  std::string text;
  std::function<void(const cv::Mat&)> draw;
};

void drawColumn(const cv::Mat& icon, int half_width, int top, const cv::Scalar& color) {
  cv::rectangle(icon, {kMiddle - half_width, top}, {kMiddle + half_width, kGround}, color,
                cv::FILLED);
}

void drawHead(const cv::Mat& icon, const cv::Scalar& color) {
  constexpr int kRadius = 4;
  cv::circle(icon, {kMiddle, kRadius + 1}, kRadius, color, cv::FILLED, cv::LINE_AA);
}

/// Side view of the shapes in class_shapes.
Entry classEntry(const std::string& text, ObjectClass object_class, int half_width, int top,
                 bool head) {
  const cv::Scalar color = toScalar(colorOfClass(object_class, true, 1.0F));
  return {text, [=](const cv::Mat& icon) {
            drawColumn(icon, half_width, top, color);
            if (head) {
              drawHead(icon, color);
            }
          }};
}

void drawStanding(const cv::Mat& icon) {
  drawColumn(icon, 18, 9, toScalar(colorOfClass(ObjectClass::kVehicle, false, 1.0F)));
}

void drawOwnVehicle(const cv::Mat& icon) { drawColumn(icon, 18, 9, toScalar(colorOfOwnVehicle())); }

void drawArrow(const cv::Mat& icon) {
  cv::arrowedLine(icon, {8, kCenter}, {kIconWidth - 8, kCenter}, kLine, 2, cv::LINE_AA, 0, 0.25);
}

void drawPath(const cv::Mat& icon) {
  const std::vector<cv::Point> points = {{6, 19}, {20, 17}, {36, 12}, {54, 5}};
  cv::polylines(icon, points, false, kLine, 2, cv::LINE_AA);
}

/// A dashed rectangle.
void drawTruth(const cv::Mat& icon) {
  constexpr int kDash = 5;
  for (int x = 10; x < kIconWidth - 10; x += 2 * kDash) {
    for (const int y : {6, kGround - 2}) {
      cv::line(icon, {x, y}, {x + kDash - 1, y}, kTruth, 1);
    }
  }
  for (int y = 6; y < kGround - 2; y += 2 * kDash) {
    for (const int x : {10, kIconWidth - 11}) {
      cv::line(icon, {x, y}, {x, y + kDash - 1}, kTruth, 1);
    }
  }
}

Entry pointsEntry(const std::string& text, std::uint8_t state) {
  const cv::Scalar color = toScalar(colorOfPoint(state));
  return {text, [=](const cv::Mat& icon) {
            for (const int x : {14, 26, 38}) {
              cv::rectangle(icon, {x, kCenter - 2, 5, 5}, color, cv::FILLED);
            }
          }};
}

Entry borderEntry(const std::string& text, RoadSide side) {
  const cv::Scalar color = toScalar(colorOfBorder(side, 1.0F, 1.0F));
  return {text, [=](const cv::Mat& icon) {
            cv::line(icon, {8, kCenter}, {kIconWidth - 8, kCenter}, color, 3);
          }};
}

std::vector<Entry> entries() {
  return {
      {"this vehicle", drawOwnVehicle},
      classEntry("vehicle", ObjectClass::kVehicle, 18, 9, false),
      classEntry("pedestrian", ObjectClass::kPedestrian, 4, 9, true),
      classEntry("cyclist", ObjectClass::kCyclist, 11, 9, true),
      classEntry("pole", ObjectClass::kPole, 2, 2, false),
      classEntry("class unknown", ObjectClass::kUnknown, 12, 9, false),
      {"stationary (pale)", drawStanding},
      {"its motion in the next second", drawArrow},
      {"its path", drawPath},
      {"true box, if known", drawTruth},
      pointsEntry("scan: static", ScanPointMessage::STATIC),
      pointsEntry("scan: moving", ScanPointMessage::MOVING),
      borderEntry("left border of the road", RoadSide::kLeft),
      borderEntry("right border", RoadSide::kRight),
  };
}

}  // namespace

sensor_msgs::ImagePtr drawLegend() {
  const std::vector<Entry> all = entries();
  auto message = boost::make_shared<sensor_msgs::Image>();
  message->encoding = sensor_msgs::image_encodings::RGB8;
  message->width = kWidth;
  message->height = static_cast<std::uint32_t>(kRowHeight * static_cast<int>(all.size()));
  message->step = message->width * 3;
  message->data.resize(std::size_t{message->step} * message->height);
  cv::Mat image(static_cast<int>(message->height), kWidth, CV_8UC3, message->data.data());
  image.setTo(kBackground);
  int top = 0;
  for (const Entry& entry : all) {
    entry.draw(image({0, top, kIconWidth, kRowHeight}));
    cv::putText(image, entry.text, {kIconWidth, top + kRowHeight - kTextInset},
                cv::FONT_HERSHEY_SIMPLEX, kTextScale, kText, 1, cv::LINE_AA);
    top += kRowHeight;
  }
  return message;
}

}  // namespace datmo
