// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/option_table.h"

#include <cmath>
#include <optional>
#include <sstream>

namespace datmo {

namespace {

class TableWriter : public OptionVisitor {
 public:
  TableWriter(std::optional<bool> is_public, const std::set<std::string>& left_out)
      : is_public_(is_public), left_out_(left_out) {
    table_ << "| parameter | unit | default | range | description |\n"
           << "|---|---|---|---|---|\n";
  }

  void number(const OptionInfo& info, double& value, const Bounds& bounds) override {
    row(info, toText(value), range(bounds));
  }

  void numbers(const OptionInfo& info, std::vector<double>& values, const Bounds& bounds) override {
    row(info, toText(values), range(bounds));
  }

  void integer(const OptionInfo& info, int& value, const Bounds& bounds) override {
    row(info, toText(value), range(bounds));
  }

  void toggle(const OptionInfo& info, bool& value) override {
    row(info, toText(value), "true, false");
  }

  void text(const OptionInfo& info, std::string& value,
            const std::vector<std::string>& allowed) override {
    std::string choices;
    for (const std::string& choice : allowed) {
      choices += (choices.empty() ? "" : ", ") + choice;
    }
    row(info, toText(value), choices.empty() ? "any text" : choices);
  }

  std::string table() const { return has_rows_ ? table_.str() : ""; }

 private:
  static std::string range(const Bounds& bounds) {
    const bool from = std::isfinite(bounds.min);
    const bool to = std::isfinite(bounds.max);
    if (from && to) {
      return toText(bounds.min) + " to " + toText(bounds.max);
    }
    return from ? "at least " + toText(bounds.min)
           : to ? "at most " + toText(bounds.max)
                : "any number";
  }

  static std::string cell(const std::string& text) {
    std::string escaped;
    for (const char letter : text) {
      escaped += letter == '|' ? "\\|" : std::string(1, letter);
    }
    return escaped;
  }

  void row(const OptionInfo& info, const std::string& value, const std::string& range) {
    const bool other_tier = is_public_ && *is_public_ != (tier(info) >= Tier::kPublic);
    if (other_tier || left_out_.count(key(info)) > 0) {
      return;
    }
    has_rows_ = true;
    table_ << "| `" << key(info) << "` | " << info.unit << " | " << cell(value) << " | "
           << cell(range) << " | " << cell(info.description)
           << (tier(info) == Tier::kLive ? "; *live*" : "") << " |\n";
  }

  std::optional<bool> is_public_;
  const std::set<std::string>& left_out_;
  bool has_rows_ = false;
  std::ostringstream table_;
};

}  // namespace

std::string detail::tableOf(const OptionWalk& visit, std::optional<bool> is_public,
                            const std::set<std::string>& left_out) {
  TableWriter writer(is_public, left_out);
  visit(writer);
  return writer.table();
}

}  // namespace datmo
