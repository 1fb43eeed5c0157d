// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "datmo_fusion/common/option_keys.h"

namespace datmo {

/// An option of a stage that a sensor set defines once for all stages.
struct SharedKey {
  std::string own;     ///< key in the stage's options: `matcher/point_sigma`
  std::string shared;  ///< section and key in the sensor set: `scanner/range_sigma`
};

/// The shared keys of one stage, built key by key: its options have `static SharedKeys
/// sharedKeys()`.
class SharedKeys {
 public:
  SharedKeys key(const std::string& own, const std::string& shared) {
    keys_.push_back({own, shared});
    return *this;
  }

  /// Adds all members of an options struct that exists in both places; groups end in a slash.
  template <typename Options>
  SharedKeys group(const std::string& own, const std::string& shared) {
    for (const std::string& name : optionKeys<Options>()) {
      keys_.push_back({own + name, shared + name});
    }
    return *this;
  }

  auto begin() const { return keys_.begin(); }
  auto end() const { return keys_.end(); }

 private:
  std::vector<SharedKey> keys_;
};

}  // namespace datmo
