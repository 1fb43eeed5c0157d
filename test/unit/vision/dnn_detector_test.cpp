// SPDX-License-Identifier: BSD-3-Clause
// Networks are not in the repository: if one is missing, its tests are skipped.
#include "datmo_fusion/vision/dnn_detector.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace datmo::dnn_detector_test {
namespace {

namespace fs = std::filesystem;

/// Beside the repository, like the data sets.
const fs::path kModels = fs::path(DATMO_FUSION_SHARED) / "models";
const fs::path kDarknet = kModels / "yolo-fastest-1.1-xl" / "yolo-fastest-1.1-xl.weights";
const fs::path kOnnx = kModels / "yolox_nano" / "yolox_nano.onnx";

class DnnDetectorOf : public testing::TestWithParam<fs::path> {
 protected:
  void SetUp() override {
    if (!fs::exists(GetParam())) {
      GTEST_SKIP() << "needs the network " << GetParam() << ", which is not there";
    }
    options_.model = GetParam().string();
  }

  DnnDetectorOptions options_;
};

TEST_P(DnnDetectorOf, SeesNothingInEmptyImages) {
  DnnDetector detector(options_);
  for (const int gray : {0, 128, 255}) {
    EXPECT_TRUE(detector.detect(cv::Mat(375, 1242, CV_8UC1, cv::Scalar(gray)), {}).empty()) << gray;
    EXPECT_TRUE(detector.detect(cv::Mat(375, 1242, CV_8UC3, cv::Scalar::all(gray)), {}).empty())
        << gray;
  }
}

TEST_P(DnnDetectorOf, LabelsOfAnotherNumberAreRefused) {
  const fs::path labels = fs::path(testing::TempDir()) / "two_labels.txt";
  std::ofstream(labels) << "person\ncar\n";
  options_.labels = labels.string();
  EXPECT_THROW(DnnDetector{options_}, ModelError);
}

TEST_P(DnnDetectorOf, ATruncatedFileIsRefused) {
  const fs::path cut = fs::path(testing::TempDir()) / ("cut" + GetParam().extension().string());
  std::ifstream whole(GetParam(), std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(whole), {}};
  std::ofstream(cut, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size() / 2));
  fs::path cfg = GetParam();
  cfg.replace_extension(".cfg");
  if (fs::exists(cfg)) {
    fs::path cut_cfg = cut;
    cut_cfg.replace_extension(".cfg");
    fs::copy_file(cfg, cut_cfg, fs::copy_options::overwrite_existing);
  }
  options_.model = cut.string();
  EXPECT_THROW(DnnDetector{options_}, ModelError);
}

INSTANTIATE_TEST_SUITE_P(Networks, DnnDetectorOf, testing::Values(kDarknet, kOnnx),
                         [](const auto& one) { return one.index == 0 ? "Darknet" : "Onnx"; });

TEST(DnnDetector, AMissingModelIsRefused) {
  DnnDetectorOptions options;
  for (const char* model :
       {"", "/nowhere/network.onnx", "/nowhere/network.weights", "/etc/hosts"}) {
    options.model = model;
    EXPECT_THROW(DnnDetector{options}, ModelError) << model;
  }
}

TEST(DnnDetector, AFileThatIsNotANetworkIsRefused) {
  const fs::path file = fs::path(testing::TempDir()) / "text.onnx";
  std::ofstream(file) << "this is no network";
  DnnDetectorOptions options;
  options.model = file.string();
  EXPECT_THROW(DnnDetector{options}, ModelError);
}

TEST(DnnDetector, InvalidSizesAreRefused) {
  DnnDetectorOptions options;
  options.width = 100;
  EXPECT_THROW(DnnDetector{options}, OptionError);
}

}  // namespace
}  // namespace datmo::dnn_detector_test
