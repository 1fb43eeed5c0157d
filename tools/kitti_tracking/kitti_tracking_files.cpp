// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/kitti_tracking_files.h"

#include <array>
#include <cmath>
#include <functional>
#include <iomanip>
#include <limits>
#include <set>
#include <sstream>
#include <utility>

#include "kitti_tracking/text_lines.h"

#include "datmo_fusion/common/angle.h"

namespace datmo::kitti {

namespace {

/// In the order of ObjectType.
const std::array<std::string, 10> kTypeNames = {
    "Car",    "Van",     "Truck", "Pedestrian", "Person_sitting",
    "Person", "Cyclist", "Tram",  "Misc",       "DontCare"};

constexpr std::size_t kLabelColumns = 17;
constexpr std::size_t kResultColumns = kLabelColumns + 1;
constexpr std::size_t kDetectionColumns = 15;
constexpr std::size_t kAlphaColumn = kDetectionColumns - 1;  ///< which some detectors omit

constexpr int kGreatest = std::numeric_limits<int>::max();
constexpr int kNobodysId = -1;
/// The files hold -1 where nothing is known.
constexpr int kUnknownLevel = -1;
constexpr int kMaxTruncated = 2;
constexpr int kMaxOccluded = 3;
/// As in the labels.
constexpr int kDecimals = 6;

ObjectType readType(const TextLine& line, std::size_t column) {
  const std::string& name = line.columns().at(column);
  std::string expected;
  for (std::size_t i = 0; i < kTypeNames.size(); ++i) {
    if (kTypeNames[i] == name) {
      return static_cast<ObjectType>(i);
    }
    expected += (i == 0 ? "" : ", ") + kTypeNames[i];
  }
  line.fail("type '" + name + "'", "one of " + expected);
}

/// Four columns: left, top, right, bottom.
ImageBox readImageBox(const TextLine& line, std::size_t first) {
  ImageBox box;
  box.left = line.number(first, "left");
  box.top = line.number(first + 1, "top");
  box.right = line.number(first + 2, "right");
  box.bottom = line.number(first + 3, "bottom");
  return box;
}

/// Seven columns: h, w, l, x, y, z, ry.
Box3 readBox(const TextLine& line, std::size_t first) {
  Box3 box;
  box.height = line.size(first, "height");
  box.width = line.size(first + 1, "width");
  box.length = line.size(first + 2, "length");
  box.x = line.number(first + 3, "x");
  box.y = line.number(first + 4, "y");
  box.z = line.number(first + 5, "z");
  box.rotation_y = line.number(first + 6, "rotation_y");
  return box;
}

/// The columns that labels and results share.
TrackedObject readTrackedObject(const TextLine& line) {
  TrackedObject object;
  object.frame = line.integer(0, "frame", 0, kGreatest);
  object.type = readType(line, 2);
  const bool counts = object.type != ObjectType::kDontCare;
  object.id = line.integer(1, "id", counts ? 0 : kNobodysId, kGreatest);
  object.truncated = line.integer(3, "truncated", kUnknownLevel, kMaxTruncated);
  object.occluded = line.integer(4, "occluded", kUnknownLevel, kMaxOccluded);
  object.alpha = line.number(5, "alpha");
  object.image_box = readImageBox(line, 6);
  if (counts) {
    object.box = readBox(line, 10);
  }
  return object;
}

TrackedObject readResult(const TextLine& line) {
  line.expectColumns(kResultColumns);
  TrackedObject object = readTrackedObject(line);
  if (object.type == ObjectType::kDontCare) {
    line.fail("type 'DontCare'", "the type of an object");
  }
  object.score = line.number(kLabelColumns, "score");
  return object;
}

ObjectType readDetectionType(const TextLine& line, std::size_t column) {
  constexpr std::array<ObjectType, 3> kTypes = {ObjectType::kPedestrian, ObjectType::kCar,
                                                ObjectType::kCyclist};
  const int number = line.integer(column, "type", 1, static_cast<int>(kTypes.size()));
  return kTypes.at(static_cast<std::size_t>(number - 1));
}

/// The heading as seen from the camera, rad.
double alphaOf(const Box3& box) {
  return normalizeAngle(box.rotation_y - std::atan2(box.x, box.z));
}

Detection readDetection(const TextLine& line) {
  const bool has_alpha = line.columns().size() != kAlphaColumn;
  if (has_alpha) {
    line.expectColumns(kDetectionColumns);
  }
  Detection detection;
  detection.frame = line.integer(0, "frame", 0, kGreatest);
  detection.type = readDetectionType(line, 1);
  detection.image_box = readImageBox(line, 2);
  detection.score = line.number(6, "score");
  detection.box = readBox(line, 7);
  detection.alpha = has_alpha ? line.number(kAlphaColumn, "alpha") : alphaOf(detection.box);
  return detection;
}

template <typename Item>
std::vector<Item> readItems(const std::string& file, char separator,
                            const std::function<Item(const TextLine&)>& read) {
  std::vector<Item> items;
  forEachLine(file, separator, [&](const TextLine& line) { items.push_back(read(line)); });
  return items;
}

}  // namespace

std::string nameOf(ObjectType type) { return kTypeNames.at(static_cast<std::size_t>(type)); }

std::vector<TrackedObject> readLabels(const std::string& file) {
  return readItems<TrackedObject>(file, ' ', [](const TextLine& line) {
    line.expectColumns(kLabelColumns);
    return readTrackedObject(line);
  });
}

std::vector<TrackedObject> readResults(const std::string& file) {
  std::set<std::pair<int, int>> seen;
  return readItems<TrackedObject>(file, ' ', [&seen](const TextLine& line) {
    const TrackedObject object = readResult(line);
    if (!seen.emplace(object.frame, object.id).second) {
      line.fail("id " + std::to_string(object.id) + " a second time in frame " +
                    std::to_string(object.frame),
                "one row for each frame and id");
    }
    return object;
  });
}

std::vector<Detection> readDetections(const std::string& file) {
  return readItems<Detection>(file, ',', readDetection);
}

std::string resultLine(const TrackedObject& object) {
  const ImageBox& image = object.image_box;
  const Box3& box = object.box;
  std::ostringstream line;
  line << std::fixed << std::setprecision(kDecimals) << object.frame << ' ' << object.id << ' '
       << nameOf(object.type) << ' ' << object.truncated << ' ' << object.occluded;
  for (const double value :
       {object.alpha, image.left, image.top, image.right, image.bottom, box.height, box.width,
        box.length, box.x, box.y, box.z, box.rotation_y, object.score}) {
    line << ' ' << value;
  }
  return line.str();
}

}  // namespace datmo::kitti
