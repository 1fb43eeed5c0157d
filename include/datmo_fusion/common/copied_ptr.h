// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <utility>

namespace datmo {

/// Owns an object of a derived class and copies it by `Base::clone()` when copied. Null only after
/// it was moved from.
template <typename Base>
class CopiedPtr {
 public:
  explicit CopiedPtr(std::unique_ptr<Base> object) : object_(std::move(object)) {}
  CopiedPtr(const CopiedPtr& other) : object_(other.object_->clone()) {}
  CopiedPtr(CopiedPtr&&) noexcept = default;
  CopiedPtr& operator=(const CopiedPtr& other) {
    object_ = other.object_->clone();
    return *this;
  }
  CopiedPtr& operator=(CopiedPtr&&) noexcept = default;
  ~CopiedPtr() = default;

  Base* operator->() { return object_.get(); }
  const Base* operator->() const { return object_.get(); }

 private:
  std::unique_ptr<Base> object_;
};

}  // namespace datmo
