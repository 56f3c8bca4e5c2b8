// Walks the records of an FBX file, text or binary.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace brittle {

// A property of a model or deformer, such as `P: "Lcl Scaling", "Lcl Scaling", "", "A",1,1,1`, or its `DeformPercent: 0`.
struct FbxProperty {
    std::string name;
    std::vector<double> numbers; // up to three; 0 in place of a text
};

// A record of the second level, such as `Geometry: 100, "Geometry::box", "Mesh"` in the section Objects.
struct FbxRecord {
    std::string_view section, key;
    std::vector<std::string> values; // the first few; numbers in decimals
    std::vector<FbxProperty> properties;
};

// Calls visit(record) for each of them in the sections Objects and Connections. Stops early if the file is damaged.
void forEachFbxRecord(std::string_view fbx, const std::function<void(const FbxRecord&)>& visit);

} // namespace brittle
