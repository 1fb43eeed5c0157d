// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/border_search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/LU>

#include "datmo_fusion/grid/rectangle_walk.h"

namespace datmo {

namespace {

/// A cell above the hit threshold, relative to the start of the search: m along the heading there
/// and outward.
struct HitCell {
  Point2 mean;    ///< of its hits
  Point2 center;  ///< of the cell
  int hits;
  int smoothed;
};

/// Content of a window.
struct Window {
  double hits = 0.0;
  std::uint64_t sections = 0;  ///< one bit per section, set if it is hit
};

int countOf(std::uint64_t bits) {
  int count = 0;
  for (; bits != 0; bits &= bits - 1) {
    ++count;
  }
  return count;
}

/// A candidate position and direction of a border.
struct Candidate {
  double distance = 0.0;  ///< m, outward
  double heading = 0.0;   ///< rad, outward
  double score = -1.0;
};

/// One search over all windows on one side, in a frame that is mirrored for the right side, so that
/// outward is always to the left.
class SideSearch {
 public:
  SideSearch(const BorderSearchOptions& options, const HitGrid& hits, const Pose2& from,
             RoadSide side)
      : options_(options),
        from_(from),
        side_(side),
        outward_(outwardOf(side, 1.0)),
        windows_(side == RoadSide::kLeft ? options.left_windows : options.right_windows) {
    gather(hits);
  }

  std::optional<FoundBorder> find() const;

 private:
  double distanceOf(int window) const { return options_.first_distance + window * options_.step; }
  void gather(const HitGrid& hits);
  std::vector<Candidate> bestOfEachDistance() const;
  void score(double heading, std::vector<Candidate>& best, std::vector<Window>& windows) const;
  FoundBorder refined(const Candidate& candidate) const;

  const BorderSearchOptions& options_;
  const Pose2& from_;
  RoadSide side_;
  double outward_;
  int windows_;
  std::vector<HitCell> cells_;
};

/// Collects all cells within any window: the windows overlap, and each cell is read once.
void SideSearch::gather(const HitGrid& hits) {
  const double turned = std::sin(options_.heading_range);
  const double margin = 0.5 * options_.width + options_.length * turned;
  const double inner = options_.first_distance - margin;
  const double outer = distanceOf(windows_ - 1) + margin;
  const double near = -0.5 * options_.width * turned;
  const double far = options_.length - near;
  const Pose2 middle(0.5 * (near + far), outward_ * 0.5 * (inner + outer), 0.0);
  const Pose2 map_in_from = from_.inverse();
  const auto mirrored = [&](const Point2& in_map) {
    const Point2 point = map_in_from * in_map;
    return Point2(point.x(), outward_ * point.y());
  };
  walkRectangle(hits.window(), {from_ * middle, far - near, outer - inner}, [&](CellIndex cell) {
    if (const int smoothed = hits.cutSmoothed(cell); smoothed > 0) {
      cells_.push_back({mirrored(hits.meanHit(cell)), mirrored(hits.window().centerOf(cell)),
                        hits.hits(cell), smoothed});
    }
  });
}

/// Scores the windows of one heading, and keeps for each distance the best over all headings.
void SideSearch::score(double heading, std::vector<Candidate>& best,
                       std::vector<Window>& windows) const {
  std::fill(windows.begin(), windows.end(), Window{});
  const double c = std::cos(heading);
  const double s = std::sin(heading);
  const double half_width = 0.5 * options_.width;
  const double sections_per_meter = options_.sections / options_.length;
  for (const HitCell& cell : cells_) {
    // A window's frame begins on the line across the vehicle, at its distance outward.
    const double y = cell.center.y() - options_.first_distance;
    const double across_first = c * y - s * cell.center.x();
    const double per_window = c * options_.step;
    const int first =
        std::max(0, static_cast<int>(std::ceil((across_first - half_width) / per_window)));
    const int last = std::min(
        windows_ - 1, static_cast<int>(std::floor((across_first + half_width) / per_window)));
    for (int i = first; i <= last; ++i) {
      const double along = c * cell.center.x() + s * (y - i * options_.step);
      if (along < 0.0 || along > options_.length) {
        continue;
      }
      const int section =
          std::min(options_.sections - 1, static_cast<int>(along * sections_per_meter));
      Window& window = windows[static_cast<std::size_t>(i)];
      window.hits += cell.smoothed;
      window.sections |= std::uint64_t{1} << section;
    }
  }
  for (int i = 0; i < windows_; ++i) {
    const Window& window = windows[static_cast<std::size_t>(i)];
    const double score = options_.score == BorderScore::kHits
                             ? window.hits
                             : static_cast<double>(countOf(window.sections)) / options_.sections;
    Candidate& candidate = best[static_cast<std::size_t>(i)];
    if (score > candidate.score) {
      candidate = {distanceOf(i), heading, score};
    }
  }
}

std::vector<Candidate> SideSearch::bestOfEachDistance() const {
  std::vector<Candidate> best(static_cast<std::size_t>(windows_));
  std::vector<Window> windows(best.size());
  // Straight ahead first, so that it wins ties.
  score(0.0, best, windows);
  const int steps = static_cast<int>(options_.heading_range / options_.heading_step + 1.0e-9);
  for (int i = 1; i <= steps; ++i) {
    score(i * options_.heading_step, best, windows);
    score(-i * options_.heading_step, best, windows);
  }
  return best;
}

std::optional<FoundBorder> SideSearch::find() const {
  const double min = options_.score == BorderScore::kHits ? options_.min_hits : options_.min_share;
  const bool take_first = options_.take == BorderChoice::kFirst;
  const std::vector<Candidate> best = bestOfEachDistance();
  const Candidate* found = nullptr;
  for (std::size_t i = 0; i < best.size(); ++i) {
    if (best[i].score <= 0.0 || best[i].score < min ||
        (found != nullptr && best[i].score <= found->score)) {
      if (found != nullptr && take_first) {
        break;
      }
      continue;
    }
    found = &best[i];
  }
  return found == nullptr ? std::nullopt : std::make_optional(refined(*found));
}

/// Fits a line to the hits under and beside the window by least squares with Cauchy weights:
/// outliers of a row (a car's rear, a post) have little influence.
FoundBorder SideSearch::refined(const Candidate& candidate) const {
  constexpr int kIterations = 5;
  Pose2 line(0.0, candidate.distance, candidate.heading);
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  Eigen::Vector2d fit = Eigen::Vector2d::Zero();
  const Pose2 from_in_line = line.inverse();
  const double shape = options_.shape_sigma * options_.shape_sigma;
  const double noise = options_.hit_sigma * options_.hit_sigma;
  for (int i = 0; i < kIterations; ++i) {
    // The position of an empty window is known to within its width, its heading to within a step.
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    information(0, 0) = 1.0 / (options_.width * options_.width);
    information(1, 1) = 1.0 / (options_.heading_step * options_.heading_step);
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const HitCell& cell : cells_) {
      const Point2 hit = from_in_line * cell.mean;
      if (cell.hits == 0 || hit.x() < 0.0 || hit.x() > options_.length ||
          std::abs(hit.y()) > options_.width) {
        continue;
      }
      const Eigen::Vector2d row(1.0, hit.x());
      const double variance = shape + noise / cell.hits;
      const double residual = hit.y() - row.dot(fit);
      const double weight = 1.0 / (variance + residual * residual);
      information += weight * row * row.transpose();
      sum += weight * hit.y() * row;
    }
    covariance = information.inverse();
    fit = covariance * sum;
  }
  line = line * Pose2(0.0, fit[0], std::atan(fit[1]));
  FoundBorder found;
  found.side = side_;
  found.line = from_ * Pose2(line.x(), outward_ * line.y(), outward_ * line.heading());
  found.length = options_.length;
  found.covariance = covariance;
  found.score = candidate.score;
  return found;
}

}  // namespace

std::vector<BorderPoint> pointsOf(const FoundBorder& found, double spacing) {
  const int steps = std::max(1, static_cast<int>(std::ceil(found.length / spacing)));
  std::vector<BorderPoint> points;
  for (int i = 0; i <= steps; ++i) {
    const double along = found.length * i / steps;
    const Eigen::Vector2d row(1.0, along);
    const double sigma = std::sqrt(row.dot(found.covariance * row));
    points.push_back({found.line * Point2(along, 0.0), sigma});
  }
  return points;
}

BorderSearch::BorderSearch(const Checked<BorderSearchOptions>& options) : options_(*options) {}

std::optional<FoundBorder> BorderSearch::search(const HitGrid& hits, const Pose2& from,
                                                RoadSide side) const {
  return SideSearch(options_, hits, from, side).find();
}

}  // namespace datmo
