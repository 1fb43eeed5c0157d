// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/map_server_files.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <vector>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/grid/row_major.h"
#include "datmo_fusion/ros/bounded_yaml.h"
#include "datmo_fusion/ros/map_files.h"

namespace datmo {

namespace {

// Same values as in map_saver.
constexpr char kOccupiedPixel = 0;
constexpr char kFreePixel = static_cast<char>(254);
constexpr char kUnknownPixel = static_cast<char>(205);
constexpr double kOccupiedThreshold = 0.65;
constexpr double kFreeThreshold = 0.196;

/// Relative tolerance within which pixels have the size of cells.
constexpr double kResolutionTolerance = 1e-6;

constexpr int kMaxPixelValue = 255;

/// Maximum number of pixels: a larger map would not fit anything here.
constexpr std::size_t kMaxPixels = 16'000'000;

/// m; maximum distance of a map from its frame's origin: cells have integer indices.
constexpr double kMaxOrigin = 1e6;

/// A pixel counts as this many hits: as certain as a surface that was seen often.
constexpr float kHitsOfPixel = 10.0F;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// m^2, of hits uniformly distributed in a pixel of 1 m.
constexpr double kVarianceOfPixel = 1.0 / 12.0;

/// Content of the yaml file.
struct MapDescription {
  std::string image;
  double resolution = 0.0;  ///< m
  Pose2 origin;             ///< of the lower left corner
  int negate = 0;           ///< 1: white is occupied
  double occupied_above = kOccupiedThreshold;
  double free_below = kFreeThreshold;
  std::string mode = "trinary";
};

struct PixelImage {
  int columns = 0;
  int rows = 0;
  std::string pixels;  ///< row by row from the top
};

template <typename Value>
void readIfPresent(const YAML::Node& node, Value& value) {
  if (node) {
    value = node.as<Value>();
  }
}

void check(const MapDescription& description, const std::string& file) {
  const Pose2& origin = description.origin;
  // Written so that NaN is rejected, too.
  if (!(std::abs(origin.x()) <= kMaxOrigin && std::abs(origin.y()) <= kMaxOrigin &&
        std::isfinite(origin.heading()))) {
    throw MapFileError(file + ": origin out of range, expected at most 1e6 m and a finite angle");
  }
  if (!(description.free_below >= 0.0 && description.free_below <= description.occupied_above &&
        description.occupied_above <= 1.0)) {
    throw MapFileError(file + ": expected 0 <= free_thresh <= occupied_thresh <= 1");
  }
  if (description.mode != "trinary") {
    throw MapFileError(file + ": mode " + description.mode + ", expected trinary");
  }
}

MapDescription readDescription(const std::string& file) {
  MapDescription description;
  try {
    const YAML::Node yaml = loadYamlFile(file);
    description.image = yaml["image"].as<std::string>();
    description.resolution = yaml["resolution"].as<double>();
    const auto origin = yaml["origin"].as<std::vector<double>>();
    description.origin = {origin.at(0), origin.at(1), origin.at(2)};
    readIfPresent(yaml["negate"], description.negate);
    readIfPresent(yaml["occupied_thresh"], description.occupied_above);
    readIfPresent(yaml["free_thresh"], description.free_below);
    readIfPresent(yaml["mode"], description.mode);
  } catch (const std::exception& error) {
    throw MapFileError(file + ": not a yaml file of map_server (" + error.what() +
                       "): expected image, resolution and origin");
  }
  check(description, file);
  return description;
}

/// Reads the next number of a PGM file's header, skipping comments.
int readNumber(std::istream& in) {
  while ((in >> std::ws).peek() == '#') {
    in.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  int number = 0;
  in >> number;
  return number;
}

PixelImage readImage(const std::string& file) {
  std::error_code unusable;
  if (!std::filesystem::is_regular_file(file, unusable)) {
    throw MapFileError(file + ": no such file, expected the image that the yaml file names");
  }
  std::ifstream in(file, std::ios::binary);
  std::string kind;
  in >> kind;
  PixelImage image;
  image.columns = readNumber(in);
  image.rows = readNumber(in);
  const int max_value = readNumber(in);
  in.get();
  if (!in || kind != "P5" || max_value != kMaxPixelValue || image.columns < 1 || image.rows < 1) {
    throw MapFileError(file + ": cannot be read: expected a binary PGM image (P5) of 8 bits");
  }
  const std::size_t size = rowMajorSize(image.columns, image.rows);
  if (size > kMaxPixels) {
    throw MapFileError(file + ": " + std::to_string(size) + " pixels, expected at most " +
                       std::to_string(kMaxPixels));
  }
  image.pixels.resize(size);
  in.read(image.pixels.data(), static_cast<std::streamsize>(size));
  if (static_cast<std::size_t>(in.gcount()) != size) {
    throw MapFileError(file + ": is truncated: " + std::to_string(in.gcount()) +
                       " pixels, expected " + std::to_string(size));
  }
  return image;
}

/// Adds a pixel to the evidence of the cell that contains it.
void add(double occupancy, const Point2& center, const MapDescription& description,
         const OccupancyMapOptions& options, CellEvidence& known) {
  const auto sure =
      static_cast<float>(std::log((1.0 - options.min_probability) / options.min_probability));
  if (occupancy > description.occupied_above) {
    const GridWindow lattice{options.window.cell_size, 1, 1, {}};
    const Eigen::Vector2f offset = (center - lattice.centerOf(known.cell)).cast<float>();
    const auto spread =
        static_cast<float>(kVarianceOfPixel * description.resolution * description.resolution);
    known.log_odds = sure;
    // Rounded up: a younger cell is not static.
    known.age = std::nextafter(static_cast<float>(options.static_after), kInfinity);
    known.hits.count += kHitsOfPixel;
    known.hits.sum += kHitsOfPixel * offset;
    known.hits.squares +=
        kHitsOfPixel * Eigen::Vector3f(offset.x() * offset.x() + spread, offset.x() * offset.y(),
                                       offset.y() * offset.y() + spread);
  } else if (known.hits.count == 0.0F) {
    known.log_odds = -sure;
  }
}

/// The window of pixels that contains all cells, with the smallest pixel side (in cells) for which
/// there are not too many.
GridWindow pixelsFor(const GridWindow& cells, int& side) {
  const CellIndex last{cells.corner.column + cells.columns - 1, cells.corner.row + cells.rows - 1};
  for (side = 1;; side *= 2) {
    const CellIndex corner = inCoarserLattice(cells.corner, side);
    const CellIndex end = inCoarserLattice(last, side);
    const GridWindow window{side * cells.cell_size, end.column - corner.column + 1,
                            end.row - corner.row + 1, corner};
    if (rowMajorSize(window.columns, window.rows) <= kMaxPixels) {
      return window;
    }
  }
}

}  // namespace

MapServerFiles toMapServerFiles(const OccupancyMap& map, const MapEvidence& evidence,
                                const std::string& image_name) {
  MapServerFiles files;
  const GridWindow window = pixelsFor(map.extent(), files.cells_of_pixel);
  std::string pixels(rowMajorSize(window.columns, window.rows), kUnknownPixel);
  for (const CellEvidence& known : evidence.cells) {
    const CellIndex pixel = inCoarserLattice(known.cell, files.cells_of_pixel);
    const int from_top = window.corner.row + window.rows - 1 - pixel.row;
    char& value =
        pixels[rowMajorIndex(pixel.column - window.corner.column, from_top, window.columns)];
    const double occupancy = 1.0F / (1.0F + std::exp(-known.log_odds));
    if (occupancy > kOccupiedThreshold) {
      value = kOccupiedPixel;
    } else if (occupancy < map.freeBelow() && value == kUnknownPixel) {
      value = kFreePixel;
    }
  }
  std::ostringstream header;
  header << "P5\n" << window.columns << ' ' << window.rows << '\n' << kMaxPixelValue << '\n';
  files.image = header.str() + pixels;
  std::ostringstream yaml;
  yaml.precision(std::numeric_limits<double>::digits10);
  yaml << "image: \"" << image_name << "\"\nresolution: " << window.cell_size << "\norigin: ["
       << window.origin().x() << ", " << window.origin().y()
       << ", 0.0]\nnegate: 0\noccupied_thresh: " << kOccupiedThreshold
       << "\nfree_thresh: " << kFreeThreshold << '\n';
  files.yaml = yaml.str();
  return files;
}

MapEvidence readMapServerFiles(const std::string& file, const OccupancyMapOptions& options) {
  const MapDescription description = readDescription(file);
  const double cell_size = options.window.cell_size;
  if (!(description.resolution > 0.0) ||
      description.resolution > cell_size * (1.0 + kResolutionTolerance)) {
    std::ostringstream message;
    message << file << ": a resolution of " << description.resolution
            << " m, expected more than 0 and at most " << cell_size
            << " m (grid_slam's map/cell_size)";
    throw MapFileError(message.str());
  }
  const std::filesystem::path image_file =
      std::filesystem::path(file).parent_path() / description.image;
  const PixelImage image = readImage(image_file.string());
  const GridWindow lattice{cell_size, 1, 1, {}};
  std::map<std::pair<int, int>, CellEvidence> cells;
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.columns; ++column) {
      const auto value =
          static_cast<unsigned char>(image.pixels[rowMajorIndex(column, row, image.columns)]);
      const double share = static_cast<double>(value) / kMaxPixelValue;
      const double occupancy = description.negate != 0 ? share : 1.0 - share;
      if (occupancy >= description.free_below && occupancy <= description.occupied_above) {
        continue;
      }
      const Point2 center =
          description.origin * Point2((column + 0.5) * description.resolution,
                                      (image.rows - row - 0.5) * description.resolution);
      const CellIndex cell = lattice.cellAt(center);
      CellEvidence& known = cells[{cell.row, cell.column}];
      known.cell = cell;
      add(occupancy, center, description, options, known);
    }
  }
  MapEvidence evidence{cell_size, {}};
  for (const auto& [index, known] : cells) {
    evidence.cells.push_back(known);
  }
  return evidence;
}

}  // namespace datmo
