// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/sequence_folders.h"

#include <filesystem>
#include <set>
#include <stdexcept>

namespace datmo::kitti {

namespace {

namespace fs = std::filesystem;

constexpr const char* kExtension = ".txt";

std::string fileOf(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / (name + kExtension)).string();
}

/// Throws unless all sequences of `folder` are in `other` as well.
void expectAll(const std::set<std::string>& names, const std::string& folder,
               const std::set<std::string>& others, const std::string& other) {
  for (const std::string& name : names) {
    if (others.count(name) == 0) {
      throw std::runtime_error(fileOf(other, name) + ": no such file, expected it along with " +
                               fileOf(folder, name));
    }
  }
}

}  // namespace

std::set<std::string> sequencesIn(const std::string& folder) {
  if (!fs::is_directory(folder)) {
    throw std::runtime_error(folder + ": not a folder, expected one with a NAME.txt per sequence");
  }
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == kExtension) {
      names.insert(entry.path().stem().string());
    }
  }
  if (names.empty()) {
    throw std::runtime_error(folder + ": has no NAME.txt, expected one per sequence");
  }
  return names;
}

std::vector<Sequence> readSequences(const std::string& labels_folder,
                                    const std::string& results_folder) {
  const std::set<std::string> labels = sequencesIn(labels_folder);
  const std::set<std::string> results = sequencesIn(results_folder);
  expectAll(labels, labels_folder, results, results_folder);
  expectAll(results, results_folder, labels, labels_folder);
  std::vector<Sequence> sequences;
  for (const std::string& name : labels) {
    sequences.push_back(
        {name, readLabels(fileOf(labels_folder, name)), readResults(fileOf(results_folder, name))});
  }
  return sequences;
}

}  // namespace datmo::kitti
