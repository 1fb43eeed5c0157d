// SPDX-License-Identifier: BSD-3-Clause
#include "class_icons.h"

#include <algorithm>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace datmo {

namespace {

/// A square of the image with x to the right and y down, each from 0 to 1.
class Icon {
 public:
  Icon(const cv::Rect& frame, const cv::Scalar& color, cv::Mat& canvas)
      : frame_(frame), color_(color), canvas_(canvas) {}

  void line(double from_x, double from_y, double to_x, double to_y) {
    cv::line(canvas_, at(from_x, from_y), at(to_x, to_y), color_, width(), cv::LINE_AA);
  }

  void disk(double x, double y, double radius) {
    cv::circle(canvas_, at(x, y), length(radius), color_, cv::FILLED, cv::LINE_AA);
  }

  void ring(double x, double y, double radius) {
    cv::circle(canvas_, at(x, y), length(radius), color_, width(), cv::LINE_AA);
  }

  void area(const std::vector<cv::Point2d>& corners) {
    std::vector<cv::Point> pixels;
    for (const cv::Point2d& corner : corners) {
      pixels.push_back(at(corner.x, corner.y));
    }
    cv::fillConvexPoly(canvas_, pixels, color_, cv::LINE_AA);
  }

 private:
  static constexpr double kLineShare = 0.08;  ///< of the icon's size

  cv::Point at(double x, double y) const {
    return {frame_.x + cvRound(x * (frame_.width - 1)),
            frame_.y + cvRound(y * (frame_.height - 1))};
  }
  int length(double share) const { return std::max(1, cvRound(share * frame_.width)); }
  int width() const { return length(kLineShare); }

  cv::Rect frame_;
  cv::Scalar color_;
  cv::Mat& canvas_;
};

void drawPerson(Icon icon) {
  icon.disk(0.5, 0.15, 0.13);
  icon.line(0.5, 0.3, 0.5, 0.65);
  icon.line(0.25, 0.42, 0.75, 0.42);
  icon.line(0.5, 0.65, 0.3, 1.0);
  icon.line(0.5, 0.65, 0.7, 1.0);
}

void drawCyclist(Icon icon) {
  icon.ring(0.22, 0.78, 0.19);
  icon.ring(0.78, 0.78, 0.19);
  icon.line(0.22, 0.78, 0.5, 0.78);
  icon.line(0.5, 0.78, 0.42, 0.45);
  icon.line(0.42, 0.45, 0.75, 0.45);
  icon.line(0.75, 0.45, 0.78, 0.78);
  icon.disk(0.58, 0.15, 0.12);
  icon.line(0.42, 0.45, 0.55, 0.28);
}

void drawCar(Icon icon) {
  icon.area({{0.05, 0.5}, {0.95, 0.5}, {0.95, 0.75}, {0.05, 0.75}});
  icon.area({{0.3, 0.22}, {0.7, 0.22}, {0.85, 0.5}, {0.15, 0.5}});
  icon.disk(0.25, 0.78, 0.12);
  icon.disk(0.75, 0.78, 0.12);
}

}  // namespace

void drawClassIcon(ObjectClass object_class, const cv::Rect& frame, const cv::Scalar& color,
                   cv::Mat& canvas) {
  Icon icon(frame, color, canvas);
  switch (object_class) {
    case ObjectClass::kPedestrian:
      return drawPerson(icon);
    case ObjectClass::kCyclist:
      return drawCyclist(icon);
    case ObjectClass::kVehicle:
      return drawCar(icon);
    case ObjectClass::kPole:
      return icon.line(0.5, 0.0, 0.5, 1.0);
    case ObjectClass::kUnknown:
      break;
  }
}

}  // namespace datmo
