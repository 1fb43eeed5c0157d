#include "datmo_fusion/fusion/object_fuser.h"

namespace datmo {

void ObjectSourceOptions::visit(OptionVisitor& visitor) {
  visitor.toggle({"use", "", "off: its objects are not read"}, use);
}

ObjectFuserOptions::ObjectFuserOptions() {
  sources["lidar"];
  sources["stereo"];
}

void ObjectFuserOptions::visit(OptionVisitor& visitor) {
  visitor.each({"sources", "", "the sensors whose objects are fused"}, sources);
}

std::vector<std::string> ObjectFuserOptions::sourcesInUse() const {
  std::vector<std::string> names;
  for (const auto& [name, source] : sources) {
    if (source.use) {
      names.push_back(name);
    }
  }
  return names;
}

ObjectFuser::ObjectFuser(const ObjectFuserOptions& options) : options_(options) {
  checkOptions(options);
}

ObjectFusionResult ObjectFuser::fuse(const std::vector<SourceObjects>& sources,
                                     const SplitScan* /*scan*/) const {
  ObjectFusionResult result;
  result.list = sources.at(0).list;
  return result;
}

}  // namespace datmo
