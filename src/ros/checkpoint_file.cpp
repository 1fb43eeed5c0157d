// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/checkpoint_file.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include <sys/stat.h>
#include <unistd.h>

#include "datmo_fusion/ros/checkpoint_check.h"
#include "datmo_fusion/ros/map_format.h"
#include "datmo_fusion/ros/whole_file.h"

namespace datmo {

namespace {

constexpr char kFormat[] = "datmo_fusion checkpoint 1";
constexpr char kPoseFormat[] = "datmo_fusion checkpoint pose 1";

/// Bytes of the header and entries of its lists: more than any configuration and any odometry of a
/// few seconds take.
constexpr std::size_t kMaxHeader = 1'000'000;
constexpr std::size_t kMaxEntries = 10'000;

constexpr char kDamaged[] = ": is truncated or modified: expected a complete checkpoint";

/// Writes the fields of a header as text.
class FieldWriter {
 public:
  FieldWriter() { out_.precision(std::numeric_limits<double>::max_digits10); }

  template <typename Number>
  void number(Number& value) {
    out_ << value << ' ';
  }
  void text(std::string& value) { out_ << std::quoted(value) << ' '; }
  /// Returns the number of entries to visit.
  std::size_t count(std::size_t size) {
    number(size);
    return size;
  }

  std::string header() const { return out_.str(); }

 private:
  std::ostringstream out_;
};

/// Reads them in the same order.
class FieldReader {
 public:
  explicit FieldReader(const std::string& header) : in_(header) {}

  template <typename Number>
  void number(Number& value) {
    in_ >> value;
  }
  void text(std::string& value) { in_ >> std::quoted(value); }
  std::size_t count(std::size_t /*size*/) {
    std::size_t size = 0;
    number(size);
    if (size > kMaxEntries) {
      in_.setstate(std::ios::failbit);
    }
    return in_ ? size : 0;
  }

  /// Whether all fields were there.
  bool isComplete() const { return !in_.fail(); }

 private:
  std::istringstream in_;
};

template <typename Fields>
void visit(Fields& fields, Stamp& stamp) {
  fields.number(stamp.nanoseconds);
}

template <typename Fields>
void visit(Fields& fields, Twist2& twist) {
  fields.number(twist.forward_speed);
  fields.number(twist.yaw_rate);
}

template <typename Fields>
void visit(Fields& fields, Pose2& pose) {
  double x = pose.x();
  double y = pose.y();
  double heading = pose.heading();
  fields.number(x);
  fields.number(y);
  fields.number(heading);
  pose = Pose2(x, y, heading);
}

template <typename Fields, int kSize>
void visit(Fields& fields, Eigen::Matrix<double, kSize, kSize>& covariance) {
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      fields.number(covariance(row, column));
    }
  }
}

template <typename Fields>
void visit(Fields& fields, OdometrySample& sample) {
  visit(fields, sample.stamp);
  visit(fields, sample.twist);
  bool has_pose = sample.base_in_odom.has_value();
  Pose2 pose = sample.base_in_odom.value_or(Pose2());
  fields.number(has_pose);
  visit(fields, pose);
  sample.base_in_odom = has_pose ? std::make_optional(pose) : std::nullopt;
  fields.number(sample.speed_measured);
  fields.number(sample.twist_measured);
}

template <typename Fields>
void visit(Fields& fields, PoseTracker::State& state) {
  visit(fields, state.stamp);
  fields.number(state.scan_interval);
  visit(fields, state.estimate.pose);
  visit(fields, state.estimate.velocity);
  fields.number(state.estimate.errors.speed_scale);
  fields.number(state.estimate.errors.yaw_rate_bias);
  visit(fields, state.estimate.covariance);
  state.odometry.resize(fields.count(state.odometry.size()));
  for (OdometrySample& sample : state.odometry) {
    visit(fields, sample);
  }
}

template <typename Fields>
void visit(Fields& fields, SlamState& slam) {
  visit(fields, slam.pose);
  visit(fields, slam.map.drift);
  visit(fields, slam.map.frame);
  fields.number(slam.map.maps_begun);
}

/// All of a checkpoint except the cells.
template <typename Fields>
void visit(Fields& fields, Checkpoint& checkpoint) {
  fields.text(checkpoint.run);
  std::vector<std::pair<std::string, std::string>> options(checkpoint.options.begin(),
                                                           checkpoint.options.end());
  options.resize(fields.count(options.size()));
  for (auto& [key, value] : options) {
    fields.text(key);
    fields.text(value);
  }
  checkpoint.options = {options.begin(), options.end()};
  visit(fields, checkpoint.slam);
}

/// A header before other content, and its checksum.
struct Header {
  std::string fields;
  std::uint32_t checksum = 0;
};

std::string headerText(const std::string& format, const Header& header) {
  return format + '\n' + std::to_string(header.fields.size()) + ' ' +
         std::to_string(header.checksum) + '\n' + header.fields;
}

/// Reads the header; the stream is then behind it.
Header readHeader(std::istream& in, const std::string& expected, const std::string& file) {
  std::string format;
  std::getline(in, format);
  if (format != expected) {
    throw MapFileError(file + ": not a checkpoint of this version: expected '" + expected +
                       "' at its start");
  }
  Header header;
  std::size_t bytes = 0;
  in >> bytes >> header.checksum;
  if (!in || in.get() != '\n' || bytes > kMaxHeader) {
    throw MapFileError(file + kDamaged);
  }
  header.fields.resize(bytes);
  in.read(header.fields.data(), static_cast<std::streamsize>(bytes));
  if (!in || checksumOf(header.fields) != header.checksum) {
    throw MapFileError(file + kDamaged);
  }
  return header;
}

/// Throws MapFileError.
void checkSize(const std::string& file, std::size_t max_cells) {
  std::error_code unusable;
  if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(file, unusable))) {
    throw MapFileError(file + ": is not a file, expected a checkpoint");
  }
  struct stat status {};
  if (stat(file.c_str(), &status) == 0 && status.st_uid != geteuid()) {
    throw MapFileError(file + ": belongs to another user, expected a checkpoint of one's own");
  }
  const std::uintmax_t bytes = std::filesystem::file_size(file, unusable);
  const std::uintmax_t max = kMaxHeader + max_cells * kMapBytesPerCell;
  if (unusable || bytes > max) {
    throw MapFileError(file + ": has " + std::to_string(bytes) + " bytes, expected at most " +
                       std::to_string(max) + " for the map of this configuration");
  }
}

std::string poseFile(const std::string& file) { return file + ".pose"; }

/// Returns the state written beside the checkpoint with this id; none if there is none.
std::optional<SlamState> readPose(const std::string& file, std::uint32_t id) {
  try {
    checkSize(file, 0);
    std::ifstream in(file, std::ios::binary);
    FieldReader fields(readHeader(in, kPoseFormat, file).fields);
    std::uint32_t belongs_to = 0;
    SlamState slam;
    fields.number(belongs_to);
    visit(fields, slam);
    const bool is_usable = fields.isComplete() && belongs_to == id && isSound(slam);
    return is_usable ? std::make_optional(slam) : std::nullopt;
  } catch (const MapFileError&) {
    return std::nullopt;  // the pose of the checkpoint itself is a little older
  }
}

}  // namespace

std::uint32_t writeCheckpoint(const std::string& file, const Checkpoint& checkpoint) {
  Checkpoint copy{checkpoint.run, checkpoint.options, checkpoint.slam, {}};
  FieldWriter fields;
  visit(fields, copy);
  const Header header{fields.header(), checksumOf(fields.header())};
  writeWholeFile(file, headerText(kFormat, header) + mapText(checkpoint.window));
  return header.checksum;
}

void writePose(const std::string& file, std::uint32_t id, const SlamState& slam) {
  SlamState copy = slam;
  FieldWriter fields;
  fields.number(id);
  visit(fields, copy);
  writeWholeFile(poseFile(file),
                 headerText(kPoseFormat, {fields.header(), checksumOf(fields.header())}));
}

Checkpoint readCheckpoint(const std::string& file, std::size_t max_cells) {
  checkSize(file, max_cells);
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    throw MapFileError(file + ": cannot be opened, expected permission to read it");
  }
  const Header header = readHeader(in, kFormat, file);
  FieldReader fields(header.fields);
  Checkpoint checkpoint;
  visit(fields, checkpoint);
  if (!fields.isComplete()) {
    throw MapFileError(file + kDamaged);
  }
  if (!isSound(checkpoint.slam)) {
    throw MapFileError(file + ": holds a state that no vehicle can have: expected a checkpoint");
  }
  checkpoint.window = readMapText(in, file);
  checkpoint.slam = readPose(poseFile(file), header.checksum).value_or(checkpoint.slam);
  return checkpoint;
}

void removeCheckpoint(const std::string& file) {
  std::error_code missing;
  for (const std::string& name : {file, poseFile(file)}) {
    std::filesystem::remove(name, missing);
  }
}

}  // namespace datmo
