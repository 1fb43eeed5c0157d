// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/mono_grid.h"

#include <algorithm>
#include <cmath>

#include "ground_view.h"
#include "image_check.h"
#include "sight_line.h"
#include <opencv2/core.hpp>

#include "datmo_fusion/grid/beam_walk.h"
#include "datmo_fusion/grid/neighborhood.h"

namespace datmo {

namespace {

LidarGridOptions scannerOptions(const MonoGridOptions& options) {
  LidarGridOptions scanner;
  scanner.window = options.window;
  scanner.beam_width = options.beam_width;
  return scanner;
}

/// Whether a cell and all its neighbors are free: no foot of an obstacle reaches into it.
bool isSurelyFree(const SensorGrid& scanned, CellIndex cell) {
  return !anyNeighbor(cell, 1, [&](CellIndex near) { return !isFree(scanned.atOrUnknown(near)); });
}

/// Adds the colors of a patch's center and of the points halfway to its corners.
void addColors(const cv::Mat& image, const cv::Rect& patch, PixelColors& colors) {
  const cv::Point middle(patch.x + patch.width / 2, patch.y + patch.height / 2);
  const int x = patch.width / 4;
  const int y = patch.height / 4;
  colors.push_back(colorAt(image, middle));
  if (x > 0 && y > 0) {
    for (const cv::Point& step : {cv::Point(x, y), cv::Point(-x, y)}) {
      colors.push_back(colorAt(image, middle + step));
      colors.push_back(colorAt(image, middle - step));
    }
  }
}

}  // namespace

void MonoGridOptions::visit(OptionVisitor& visitor) {
  visitor.group("window", [&] { window.visit(visitor); });
  visitor.choice({"method", "",
                  "lines: patches of the image along lines of sight, bounded by the scan's depth "
                  "and by obstacles on the road; thesis: the pixel at each beam's end decides for "
                  "its whole line (thesis 4.1.4)"},
                 method, {{"lines", MonoGridMethod::kLines}, {"thesis", MonoGridMethod::kThesis}});
  visitor.number(
      {"occupied_probability", "1", "occupancy of an occupied cell (thesis 4.1.4: high)"},
      occupied_probability, {0.51, 0.99});
  visitor.number({"free_probability", "1", "occupancy of a free cell (thesis 4.1.4: low)"},
                 free_probability, {0.01, 0.49});
  visitor.number({"beam_width", "rad",
                  "opening angle of a beam of the scanner; 0: it reaches halfway to its neighbors"},
                 beam_width, {0.0, 0.2});
  visitor.number({"effective_range", "m",
                  "cells farther from the camera are unknown (lines only): there, a cell is less "
                  "than a row of the image",
                  Tier::kPublic},
                 effective_range, {1.0, 100.0});
  visitor.number(
      {"learning_range", "m",
       "the road's colors are learned from cells up to this range that the scanner sees free"},
      learning_range, {1.0, 100.0});
  visitor.number(
      {"min_obstacle_height", "m", "lower objects are not obstacles: paint, curbs (lines only)"},
      min_obstacle_height, {0.01, 2.0});
  visitor.number({"pitch_sigma", "rad",
                  "standard deviation of the camera's pitch over the road: springs and slopes "
                  "(lines only)"},
                 pitch_sigma, {0.0, 0.2});
  visitor.group("color", [&] { color.visit(visitor); });
}

MonoGridModel::MonoGridModel(const Checked<MonoGridOptions>& options)
    : options_(*options),
      window_(options->window.window()),
      scanner_(scannerOptions(*options)),
      color_(options->color) {}

MonoGridResult MonoGridModel::grid(const cv::Mat& image, const MountedCamera& camera,
                                   const Scan& scan, double scanner_height) {
  checkImage(image);
  checkSize(image, camera);
  const GroundView view(camera);
  const SensorGrid scanned = scanner_.grid(scan);
  MonoGridResult result;
  result.grid = SensorGrid(scan.stamp, window_);
  if (!view.seesRoad()) {
    return result;
  }
  // Learns after classification: what is too low for the scanner must not become road at once.
  const bool known = color_.isKnown(image.channels());
  if (!known) {
    result.learned = learn(image, camera, scanned);
  }
  if (!color_.isKnown(image.channels())) {
    return result;
  }
  if (options_.method == MonoGridMethod::kThesis) {
    fillAsInThesis(image, camera, scan, scanner_height, result.grid);
  } else {
    const RoadPixels pixels(image, color_);
    SightLines(options_, view, scanned, pixels).fill(result.grid);
  }
  if (known) {
    result.learned = learn(image, camera, scanned);
  }
  const auto& cells = result.grid.cells();
  result.free = static_cast<std::size_t>(std::count_if(cells.begin(), cells.end(), isFree));
  result.occupied = static_cast<std::size_t>(std::count_if(cells.begin(), cells.end(), isOccupied));
  return result;
}

std::size_t MonoGridModel::learn(const cv::Mat& image, const MountedCamera& camera,
                                 const SensorGrid& scanned) {
  const GroundView view(camera);
  PixelColors colors;
  SensorGrid sampled(scanned.stamp(), window_);  // known: each cell counts once, near or far
  for (const Point2& direction :
       view.directions(options_.learning_range, options_.window.cell_size)) {
    const SightLine line = sightLine(view, direction, scanned, options_.learning_range, 0.0);
    for (const SightStep& step : line) {
      if (step.is_hit) {
        break;  // the camera may see the obstacle instead of what is beyond it
      }
      if (sampled.at(step.cell) == kUnknownPercent && isSurelyFree(scanned, step.cell)) {
        sampled.at(step.cell) = kUndecidedPercent;
        addColors(image, step.patch, colors);
      }
    }
  }
  color_.learn(colors, scanned.stamp());
  return colors.size();
}

void MonoGridModel::fillAsInThesis(const cv::Mat& image, const MountedCamera& camera,
                                   const Scan& scan, double scanner_height,
                                   SensorGrid& grid) const {
  const GroundView view(camera);
  const double reach = window_.cell_size * std::hypot(window_.columns, window_.rows);
  for (const Ray& ray : scan.rays) {
    const Eigen::Vector3d end(ray.end.x(), ray.end.y(), scanner_height);
    const auto pixel = ray.hit ? view.pixel(end) : std::nullopt;
    if (!pixel) {
      continue;
    }
    const bool is_object = color_.distance(colorAt(image, *pixel)) > options_.thesis_distance;
    const Percent percent =
        toPercent(is_object ? options_.occupied_probability : options_.free_probability);
    const Point2 along = reach * (ray.end - view.position()).normalized();
    const Beam beam{view.position(), along, reach, std::abs(scan.field.beam_spacing)};
    forEachLine(window_, beam, [&](const Point2& to) {
      walkRay(window_, beam.from, to, [&](CellIndex cell) {
        if (window_.contains(cell)) {
          grid.at(cell) = std::max(grid.at(cell), percent);
        }
      });
    });
  }
}

}  // namespace datmo
