#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace barehand::ros {

// The ROS 2 messages that the program writes or reads. Their fields have the names, the order and the meaning of the
// ROS packages. `fields` passes every field with its name to a visitor; both the encoding (cdr.h) and the schema
// (schema.h) are derived from it. `kType`: package and name.

struct Time {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  bool operator==(const Time&) const = default;
  static constexpr const char* kType = "builtin_interfaces/Time";
  static void fields(auto& v, auto& m) { v("sec", m.sec), v("nanosec", m.nanosec); }
};

struct Duration {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  static constexpr const char* kType = "builtin_interfaces/Duration";
  static void fields(auto& v, auto& m) { v("sec", m.sec), v("nanosec", m.nanosec); }
};

struct Header {
  Time stamp;
  std::string frame_id;
  static constexpr const char* kType = "std_msgs/Header";
  static void fields(auto& v, auto& m) { v("stamp", m.stamp), v("frame_id", m.frame_id); }
};

struct ColorRGBA {
  float r = 0, g = 0, b = 0, a = 1;
  static constexpr const char* kType = "std_msgs/ColorRGBA";
  static void fields(auto& v, auto& m) { v("r", m.r), v("g", m.g), v("b", m.b), v("a", m.a); }
};

struct Point {
  double x = 0, y = 0, z = 0;
  static constexpr const char* kType = "geometry_msgs/Point";
  static void fields(auto& v, auto& m) { v("x", m.x), v("y", m.y), v("z", m.z); }
};

struct Vector3 {
  double x = 0, y = 0, z = 0;
  static constexpr const char* kType = "geometry_msgs/Vector3";
  static void fields(auto& v, auto& m) { v("x", m.x), v("y", m.y), v("z", m.z); }
};

struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;
  static constexpr const char* kType = "geometry_msgs/Quaternion";
  static void fields(auto& v, auto& m) { v("x", m.x), v("y", m.y), v("z", m.z), v("w", m.w); }
};

struct Pose {
  Point position;
  Quaternion orientation;
  static constexpr const char* kType = "geometry_msgs/Pose";
  static void fields(auto& v, auto& m) { v("position", m.position), v("orientation", m.orientation); }
};

struct Transform {
  Vector3 translation;
  Quaternion rotation;
  static constexpr const char* kType = "geometry_msgs/Transform";
  static void fields(auto& v, auto& m) { v("translation", m.translation), v("rotation", m.rotation); }
};

struct TransformStamped {
  Header header;
  std::string child_frame_id;
  Transform transform;
  static constexpr const char* kType = "geometry_msgs/TransformStamped";
  static void fields(auto& v, auto& m) {
    v("header", m.header), v("child_frame_id", m.child_frame_id), v("transform", m.transform);
  }
};

struct TFMessage {
  std::vector<TransformStamped> transforms;
  static constexpr const char* kType = "tf2_msgs/TFMessage";
  static void fields(auto& v, auto& m) { v("transforms", m.transforms); }
};

struct JointState {
  Header header;
  std::vector<std::string> name;
  std::vector<double> position, velocity, effort;
  static constexpr const char* kType = "sensor_msgs/JointState";
  static void fields(auto& v, auto& m) {
    v("header", m.header), v("name", m.name);
    v("position", m.position), v("velocity", m.velocity), v("effort", m.effort);
  }
};

/// An image; each row has `step` bytes. Encodings that are read: 16UC1 and mono16 (depth), rgb8 and bgr8 (colour).
struct Image {
  Header header;
  std::uint32_t height = 0, width = 0;
  std::string encoding;
  std::uint8_t is_bigendian = 0;
  std::uint32_t step = 0;
  std::vector<std::uint8_t> data;
  static constexpr const char* kType = "sensor_msgs/Image";
  static void fields(auto& v, auto& m) {
    v("header", m.header), v("height", m.height), v("width", m.width), v("encoding", m.encoding);
    v("is_bigendian", m.is_bigendian), v("step", m.step), v("data", m.data);
  }
};

struct CompressedImage {
  Header header;
  std::string format;  ///< "png" or "jpeg"
  std::vector<std::uint8_t> data;
  static constexpr const char* kType = "sensor_msgs/CompressedImage";
  static void fields(auto& v, auto& m) { v("header", m.header), v("format", m.format), v("data", m.data); }
};

struct RegionOfInterest {
  std::uint32_t x_offset = 0, y_offset = 0, height = 0, width = 0;
  bool do_rectify = false;
  static constexpr const char* kType = "sensor_msgs/RegionOfInterest";
  static void fields(auto& v, auto& m) {
    v("x_offset", m.x_offset), v("y_offset", m.y_offset), v("height", m.height), v("width", m.width);
    v("do_rectify", m.do_rectify);
  }
};

/// Intrinsics of a camera. k (3x3), r (3x3) and p (3x4) are the intrinsic, rectification and projection matrices,
/// row-major [px].
struct CameraInfo {
  Header header;
  std::uint32_t height = 0, width = 0;
  std::string distortion_model;
  std::vector<double> d;
  std::array<double, 9> k{}, r{};
  std::array<double, 12> p{};
  std::uint32_t binning_x = 0, binning_y = 0;
  RegionOfInterest roi;
  static constexpr const char* kType = "sensor_msgs/CameraInfo";
  static void fields(auto& v, auto& m) {
    v("header", m.header), v("height", m.height), v("width", m.width), v("distortion_model", m.distortion_model);
    v("d", m.d), v("k", m.k), v("r", m.r), v("p", m.p);
    v("binning_x", m.binning_x), v("binning_y", m.binning_y), v("roi", m.roi);
  }
};

struct PointField {
  static constexpr std::uint8_t kFloat32 = 7;
  std::string name;
  std::uint32_t offset = 0;
  std::uint8_t datatype = kFloat32;
  std::uint32_t count = 1;
  static constexpr const char* kType = "sensor_msgs/PointField";
  static void fields(auto& v, auto& m) {
    v("name", m.name), v("offset", m.offset), v("datatype", m.datatype), v("count", m.count);
  }
};

struct PointCloud2 {
  Header header;
  std::uint32_t height = 1, width = 0;
  std::vector<PointField> point_fields;
  bool is_bigendian = false;
  std::uint32_t point_step = 0, row_step = 0;
  std::vector<std::uint8_t> data;
  bool is_dense = true;
  static constexpr const char* kType = "sensor_msgs/PointCloud2";
  static void fields(auto& v, auto& m) {
    v("header", m.header), v("height", m.height), v("width", m.width), v("fields", m.point_fields);
    v("is_bigendian", m.is_bigendian), v("point_step", m.point_step), v("row_step", m.row_step);
    v("data", m.data), v("is_dense", m.is_dense);
  }
};

struct UVCoordinate {
  float u = 0, v = 0;
  static constexpr const char* kType = "visualization_msgs/UVCoordinate";
  static void fields(auto& visit, auto& m) { visit("u", m.u), visit("v", m.v); }
};

struct MeshFile {
  std::string filename;
  std::vector<std::uint8_t> data;
  static constexpr const char* kType = "visualization_msgs/MeshFile";
  static void fields(auto& v, auto& m) { v("filename", m.filename), v("data", m.data); }
};

/// A shape to be drawn; the fields are those of ROS 2 Humble and later.
struct Marker {
  static constexpr std::int32_t kSphere = 2, kCylinder = 3;  ///< values of `type`; a cylinder's axis is z
  static constexpr std::int32_t kAdd = 0, kDeleteAll = 3;    ///< values of `action`
  Header header;
  std::string ns;
  std::int32_t id = 0, type = kSphere, action = kAdd;
  Pose pose;
  Vector3 scale;  ///< full lengths (diameters) along the axes [m]
  ColorRGBA color;
  Duration lifetime;  ///< 0: until the marker is replaced
  bool frame_locked = false;
  std::vector<Point> points;
  std::vector<ColorRGBA> colors;
  std::string texture_resource;
  CompressedImage texture;
  std::vector<UVCoordinate> uv_coordinates;
  std::string text, mesh_resource;
  MeshFile mesh_file;
  bool mesh_use_embedded_materials = false;
  static constexpr const char* kType = "visualization_msgs/Marker";
  static void fields(auto& v, auto& m) {
    v("header", m.header), v("ns", m.ns), v("id", m.id), v("type", m.type), v("action", m.action);
    v("pose", m.pose), v("scale", m.scale), v("color", m.color), v("lifetime", m.lifetime);
    v("frame_locked", m.frame_locked), v("points", m.points), v("colors", m.colors);
    v("texture_resource", m.texture_resource), v("texture", m.texture), v("uv_coordinates", m.uv_coordinates);
    v("text", m.text), v("mesh_resource", m.mesh_resource), v("mesh_file", m.mesh_file);
    v("mesh_use_embedded_materials", m.mesh_use_embedded_materials);
  }
};

struct MarkerArray {
  std::vector<Marker> markers;
  static constexpr const char* kType = "visualization_msgs/MarkerArray";
  static void fields(auto& v, auto& m) { v("markers", m.markers); }
};

struct KeyValue {
  std::string key, value;
  static constexpr const char* kType = "diagnostic_msgs/KeyValue";
  static void fields(auto& v, auto& m) { v("key", m.key), v("value", m.value); }
};

struct DiagnosticStatus {
  static constexpr std::byte kOk{0}, kWarn{1}, kError{2}, kStale{3};
  std::byte level = kOk;
  std::string name, message, hardware_id;
  std::vector<KeyValue> values;
  static constexpr const char* kType = "diagnostic_msgs/DiagnosticStatus";
  static void fields(auto& v, auto& m) {
    v("level", m.level), v("name", m.name), v("message", m.message), v("hardware_id", m.hardware_id);
    v("values", m.values);
  }
};

struct DiagnosticArray {
  Header header;
  std::vector<DiagnosticStatus> status;
  static constexpr const char* kType = "diagnostic_msgs/DiagnosticArray";
  static void fields(auto& v, auto& m) { v("header", m.header), v("status", m.status); }
};

/// A message of the LCM network as it stands there: lcmtypes/*.lcm say what `data` holds. This type is not one of ROS;
/// it keeps in a file what the types of ROS have no fields for, such as raw poses and covariances.
struct LcmMessage {
  Header header;
  std::string channel;  ///< without a prefix: "HAND_STATE"
  std::vector<std::uint8_t> data;
  static constexpr const char* kType = "barehand_msgs/LcmMessage";
  static void fields(auto& v, auto& m) { v("header", m.header), v("channel", m.channel), v("data", m.data); }
};

}  // namespace barehand::ros
