// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "datmo_fusion/ros/shared_options.h"

namespace datmo {

/// The options of all stages: the sections of config/<sensor set>.yaml.
class SensorSet {
 public:
  /// Reads a yaml file and those of presets, whose values override the previous ones, and checks
  /// the sections of all stages. Throws OptionError that names file, section and key.
  explicit SensorSet(const std::string& file, const std::vector<std::string>& presets = {});

  /// The sections that apply to all stages.
  const SharedOptions& shared() const { return shared_; }

  /// The values of a section; empty if there is none of this name.
  OptionValues values(const std::string& section) const;

  /// The options of a stage. Throws OptionError.
  template <typename Options>
  Options options(const std::string& section) const {
    return readStageOptions<Options>(values(section), shared_);
  }

  /// Overrides a value of the file. Throws OptionError that names the section.
  void set(const std::string& section, const std::string& key, const OptionValue& value);

 private:
  /// Overrides the present values by those of a file.
  void read(const std::string& file);
  void readShared();
  void check(const std::string& section) const;

  std::string file_;  ///< and the presets'
  std::map<std::string, OptionValues> sections_;
  SharedOptions shared_;
};

}  // namespace datmo
