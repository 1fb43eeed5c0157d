// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/sync/source_matcher.h"

namespace datmo {

void SourceMatcherOptions::visit(OptionVisitor& visitor) {
  visitor.text({"reference", "",
                "source that sets the stamps of the fused result; while it is silent, the next one "
                "by name sets them"},
               reference, {});
  visitor.number({"tolerance", "s", "data this close in time are fused with the reference's"},
                 tolerance, {0.0, 1.0});
  visitor.number({"max_wait", "s", "longest time that the reference's data wait for the others",
                  Tier::kPublic},
                 max_wait, {0.0, 1.0});
  visitor.number(
      {"silent_after", "s", "a source that has sent nothing for this long is not waited for"},
      silent_after, {0.05, 10.0});
}

void checkReference(const SourceMatcherOptions& options, const std::vector<std::string>& sources) {
  std::string names;
  for (const std::string& source : sources) {
    names += (names.empty() ? "" : ", ") + source;
  }
  if (std::find(sources.begin(), sources.end(), options.reference) == sources.end()) {
    throw OptionError("reference = \"" + options.reference + "\": expected one of the sources (" +
                      names + ")");
  }
}

const char* toText(WhyMissing why) {
  switch (why) {
    case WhyMissing::kSilent:
      return "silent";
    case WhyMissing::kNoneNear:
      return "none near";
    case WhyMissing::kNoMotion:
      return "no motion";
  }
  return "";
}

}  // namespace datmo
