#include "tests/support/model_texts.h"

#include <algorithm>
#include <stdexcept>

namespace support {

using brittle::Double3;
using brittle::FileAxis;

namespace {

std::string boxCorners(const Double3& size) {
    std::string text;
    for (int k = 0; k < 8; ++k)
        for (int axis = 0; axis < 3; ++axis)
            text += (text.empty() ? "" : ",") + std::to_string(k >> axis & 1 ? size[static_cast<size_t>(axis)] : 0.0);
    return text;
}

std::string axisLines(const std::string& name, const FileAxis& axis) {
    return "P: \"" + name + "\", \"int\", \"Integer\", \"\"," + std::to_string(axis.index) + "\nP: \"" + name +
           "Sign\", \"int\", \"Integer\", \"\"," + std::to_string(axis.sign) + "\n";
}

} // namespace

std::string settingsBlock(const FbxSettings& settings) {
    return "GlobalSettings: {\nVersion: 1000\nProperties70: {\n" + axisLines("UpAxis", settings.up) +
           axisLines("FrontAxis", settings.front) + axisLines("CoordAxis", settings.right) +
           "P: \"UnitScaleFactor\", \"double\", \"Number\", \"\"," + std::to_string(settings.unit) + "\n}\n}\n";
}

std::string fbx(const std::string& settings, const Double3& size, double node_scale) {
    const std::string scale = std::to_string(node_scale);
    return "; FBX 7.4.0 project file\nFBXHeaderExtension: {\nFBXHeaderVersion: 1003\nFBXVersion: 7400\n}\n" + settings +
           "Definitions: {\nVersion: 100\nCount: 2\nObjectType: \"Geometry\" {\nCount: 1\n}\nObjectType: \"Model\" {\nCount: "
           "1\n}"
           "\n}\nObjects: {\nGeometry: 100, \"Geometry::box\", \"Mesh\" {\nVertices: *24 {\na: " +
           boxCorners(size) +
           "\n}\nPolygonVertexIndex: *24 {\na: 0,2,3,-2,4,5,7,-7,0,1,5,-5,2,6,7,-4,0,4,6,-3,1,3,7,-6\n}\nGeometryVersion: "
           "124\n}\n"
           "Model: 200, \"Model::box\", \"Mesh\" {\nVersion: 232\nProperties70: {\nP: \"Lcl Scaling\", \"Lcl Scaling\", \"\", "
           "\"A\"," +
           scale + "," + scale + "," + scale +
           "\n}\nShading: T\nCulling: \"CullingOff\"\n}\n}\nConnections: {\nC: \"OO\",200,0\nC: \"OO\",100,200\n}\n";
}

std::string collada(const std::string& asset, const Double3& size) {
    std::string corners = boxCorners(size);
    std::replace(corners.begin(), corners.end(), ',', ' ');
    return "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\"><asset>" +
           asset + "</asset><library_geometries><geometry id=\"g\"><mesh><source id=\"p\"><float_array id=\"a\" count=\"24\">" +
           corners +
           "</float_array><technique_common><accessor source=\"#a\" count=\"8\" stride=\"3\"><param name=\"X\" type=\"float\"/>"
           "<param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor></technique_common></source>"
           "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices><polylist count=\"6\"><input "
           "semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><vcount>4 4 4 4 4 4</vcount><p>0 2 3 1 4 5 7 6 0 1 5 4 2 6 7 3 0 4 "
           "6 2 "
           "1 3 7 5</p></polylist></mesh></geometry></library_geometries><library_visual_scenes><visual_scene id=\"s\"><node "
           "id=\"n\"><instance_geometry "
           "url=\"#g\"/></node></visual_scene></library_visual_scenes><scene><instance_visual_scene "
           "url=\"#s\"/></scene></COLLADA>";
}

std::string withReplaced(std::string text, const std::string& from, const std::string& to) {
    const size_t at = text.find(from);
    if (at == text.npos || text.find(from, at + 1) != text.npos) throw std::invalid_argument(from + " is not there once");
    return text.replace(at, from.size(), to);
}

} // namespace support
