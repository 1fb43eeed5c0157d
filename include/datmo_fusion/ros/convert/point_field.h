// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <sensor_msgs/PointField.h>

namespace datmo {

/// Returns the description of one number of each point of a cloud; `offset`: bytes from its first.
inline sensor_msgs::PointField pointField(const std::string& name, std::size_t offset,
                                          std::uint8_t type = sensor_msgs::PointField::FLOAT32) {
  sensor_msgs::PointField field;
  field.name = name;
  field.offset = static_cast<std::uint32_t>(offset);
  field.datatype = type;
  field.count = 1;
  return field;
}

/// Returns the description of points that consist of these floats, without gaps.
inline std::vector<sensor_msgs::PointField> floatFields(const std::vector<const char*>& names) {
  std::vector<sensor_msgs::PointField> fields;
  for (const char* const name : names) {
    fields.push_back(pointField(name, fields.size() * sizeof(float)));
  }
  return fields;
}

}  // namespace datmo
