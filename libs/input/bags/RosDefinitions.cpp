#include "input/bags/RosDefinitions.h"

namespace scanloom
{
namespace
{
/** A message that another one contains. */
std::string within(const std::string& type, const std::string& definition)
{
  return "\n" + std::string(80, '=') + "\nMSG: " + type + "\n" + definition;
}

std::string headerDefinition()
{
  return within("std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n") +
         within("builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n");
}

std::string vectorDefinition() { return within("geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"); }

std::string quaternionDefinition()
{
  return within("geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n");
}
}  // namespace

McapSchema pointCloudSchema()
{
  return {"sensor_msgs/msg/PointCloud2",
          "std_msgs/Header header\nuint32 height\nuint32 width\nsensor_msgs/PointField[] fields\nbool is_bigendian\n"
          "uint32 point_step\nuint32 row_step\nuint8[] data\nbool is_dense\n" +
              within("sensor_msgs/PointField",
                     "uint8 INT8=1\nuint8 UINT8=2\nuint8 INT16=3\nuint8 UINT16=4\nuint8 INT32=5\nuint8 UINT32=6\n"
                     "uint8 FLOAT32=7\nuint8 FLOAT64=8\nstring name\nuint32 offset\nuint8 datatype\nuint32 count\n") +
              headerDefinition()};
}

McapSchema imuSchema()
{
  return {"sensor_msgs/msg/Imu",
          "std_msgs/Header header\ngeometry_msgs/Quaternion orientation\nfloat64[9] orientation_covariance\n"
          "geometry_msgs/Vector3 angular_velocity\nfloat64[9] angular_velocity_covariance\n"
          "geometry_msgs/Vector3 linear_acceleration\nfloat64[9] linear_acceleration_covariance\n" +
              quaternionDefinition() + vectorDefinition() + headerDefinition()};
}

McapSchema transformsSchema()
{
  return {
      "tf2_msgs/msg/TFMessage",
      "geometry_msgs/TransformStamped[] transforms\n" +
          within("geometry_msgs/TransformStamped",
                 "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n") +
          within("geometry_msgs/Transform", "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n") +
          vectorDefinition() + quaternionDefinition() + headerDefinition()};
}

McapSchema pathSchema()
{
  return {"nav_msgs/msg/Path",
          "std_msgs/Header header\ngeometry_msgs/PoseStamped[] poses\n" +
              within("geometry_msgs/PoseStamped", "std_msgs/Header header\ngeometry_msgs/Pose pose\n") +
              within("geometry_msgs/Pose", "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n") +
              within("geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n") + quaternionDefinition() +
              headerDefinition()};
}

McapSchema schemaOf(const std::string& type)
{
  for (const McapSchema& known : {pointCloudSchema(), imuSchema(), transformsSchema(), pathSchema()})
    if (known.type == type) return known;
  return {type, type == "std_msgs/msg/String" ? "string data\n" : ""};
}
}  // namespace scanloom
