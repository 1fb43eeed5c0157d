// SPDX-License-Identifier: BSD-3-Clause
#include "track_drawing.h"

#include <algorithm>
#include <cmath>

#include "class_icons.h"
#include "track_label.h"
#include <opencv2/imgproc.hpp>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/display/marker_colors.h"

namespace datmo {

namespace {

constexpr double kNear = 0.3;  // m: closer than any mounted camera sees another road user
constexpr double kFullChannel = 255.0;
constexpr double kLetterHeight = 22.0;  // px, of OpenCV's font at scale 1
constexpr int kMargin = 3;              // px, around a label's text
constexpr double kMinOpacity = 0.3;     // improbable tracks remain visible
const cv::Scalar kText(255, 255, 255);

cv::Scalar toBgr(const std_msgs::ColorRGBA& color) {
  return kFullChannel * cv::Scalar(color.b, color.g, color.r);
}

/// Clips ends far outside the image, of edges beside the camera, first: OpenCV draws with 16 bits.
void drawEdges(const std::vector<ImageSegment>& edges, const cv::Scalar& color, int line_width,
               cv::Mat& canvas) {
  for (const ImageSegment& edge : edges) {
    cv::Point2l from(std::lround(edge.from.x()), std::lround(edge.from.y()));
    cv::Point2l to(std::lround(edge.to.x()), std::lround(edge.to.y()));
    if (cv::clipLine(cv::Size2l(canvas.cols, canvas.rows), from, to)) {
      cv::line(canvas, from, to, color, line_width, cv::LINE_AA);
    }
  }
}

/// A label: a filled rectangle with text.
struct Label {
  std::string text;
  double scale = 1.0;  ///< of the text
  int baseline = 0;    ///< px, below the text's baseline
  int icon = 0;        ///< px, side of the class icon before the text; 0: none
  cv::Rect frame;
};

/// Label above the box; at the upper edge of the image if there is no room.
Label labelAbove(const TrackBox& box, const Eigen::AlignedBox2d& bounds,
                 const CameraViewOptions& options, const cv::Size& image) {
  Label label;
  label.text = box.text + " " + std::to_string(std::lround(box.distance)) + " m";
  label.scale = options.text_height / kLetterHeight;
  const cv::Size letters =
      cv::getTextSize(label.text, cv::FONT_HERSHEY_SIMPLEX, label.scale, 1, &label.baseline);
  label.icon = box.object_class == ObjectClass::kUnknown ? 0 : letters.height + label.baseline;
  label.frame.width = letters.width + 2 * kMargin + (label.icon > 0 ? label.icon + kMargin : 0);
  label.frame.height = letters.height + label.baseline + 2 * kMargin;
  label.frame.x =
      std::clamp(cvRound(bounds.min().x()), 0, std::max(0, image.width - label.frame.width));
  label.frame.y = std::max(0, cvRound(bounds.min().y()) - label.frame.height - options.line_width);
  return label;
}

/// Moves a label up until it overlaps none of the others.
void moveClear(const std::vector<Label>& others, Label& label) {
  for (bool moved = true; moved && label.frame.y > 0;) {
    moved = false;
    for (const Label& other : others) {
      if ((other.frame & label.frame).area() > 0) {
        label.frame.y = std::max(0, other.frame.y - label.frame.height);
        moved = true;
      }
    }
  }
}

void drawLabel(const Label& label, const TrackBox& box, cv::Mat& canvas) {
  cv::rectangle(canvas, label.frame, box.color, cv::FILLED);
  const cv::Point corner = label.frame.tl() + cv::Point(kMargin, kMargin);
  if (label.icon > 0) {
    drawClassIcon(box.object_class, {corner, cv::Size(label.icon, label.icon)}, kText, canvas);
  }
  const cv::Point feet(corner.x + (label.icon > 0 ? label.icon + kMargin : 0),
                       label.frame.y + label.frame.height - kMargin - label.baseline);
  cv::putText(canvas, label.text, feet, cv::FONT_HERSHEY_SIMPLEX, label.scale, kText, 1,
              cv::LINE_AA);
}

/// Draws a box and its label with its opacity. `bounds`: of the box in the image.
void drawFaded(const TrackBox& box, const std::vector<ImageSegment>& edges,
               const Eigen::AlignedBox2d& bounds, const Label& label,
               const CameraViewOptions& options, cv::Mat& canvas) {
  const cv::Point first(cvFloor(bounds.min().x()), cvFloor(bounds.min().y()));
  const cv::Point last(cvCeil(bounds.max().x()), cvCeil(bounds.max().y()));
  const int border = options.line_width + 1;
  cv::Rect area = cv::Rect(first - cv::Point(border, border), last + cv::Point(border, border));
  area = (area | label.frame) & cv::Rect(cv::Point(), canvas.size());
  const cv::Mat before = canvas(area).clone();
  drawEdges(edges, box.color, options.line_width, canvas);
  drawLabel(label, box, canvas);
  cv::Mat shown = canvas(area);
  cv::addWeighted(shown, box.opacity, before, 1.0 - box.opacity, 0.0, shown);
}

}  // namespace

TrackBox trackBox(const TrackMessage& track, double later, const Eigen::Isometry3d& fixed_in_camera,
                  const CameraViewOptions& options) {
  const Pose2 pose = fromMessage(track.pose);
  Eigen::Isometry3d in_fixed(Eigen::AngleAxisd(pose.heading(), Eigen::Vector3d::UnitZ()));
  in_fixed.translation() = Eigen::Vector3d(pose.x() + later * track.velocity.x,
                                           pose.y() + later * track.velocity.y, 0.0);
  TrackBox result;
  result.box.pose = fixed_in_camera * in_fixed;
  result.box.size = {std::max(track.size.x, options.min_size),
                     std::max(track.size.y, options.min_size),
                     track.size.z > 0.0 ? track.size.z : options.default_height};
  result.object_class = classFromMessage(track.classification);
  result.color = toBgr(colorOfClass(result.object_class, true, 1.0F));
  const auto existence = static_cast<double>(track.existence_probability);
  result.opacity = existence > kMinOpacity ? std::min(existence, 1.0) : kMinOpacity;
  result.text = labelText(track);
  return result;
}

void drawTrackBoxes(const PinholeCamera& camera, std::vector<TrackBox> boxes,
                    const CameraViewOptions& options, cv::Mat& canvas) {
  std::sort(boxes.begin(), boxes.end(), [](const TrackBox& left, const TrackBox& right) {
    return left.distance < right.distance;
  });
  std::vector<Label> labels;
  for (const TrackBox& box : boxes) {
    const auto edges = projectBox(camera, box.box, kNear);
    const auto bounds = boundsInImage(edges, canvas.cols, canvas.rows);
    if (!bounds.isEmpty()) {
      Label label = labelAbove(box, bounds, options, canvas.size());
      moveClear(labels, label);
      drawFaded(box, edges, bounds, label, options, canvas);
      labels.push_back(label);
    }
  }
}

}  // namespace datmo
