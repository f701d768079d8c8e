# `cpack -G DEB` in the build folder: scanloom, scanloom-mrpt-plugin, libscanloom-dev, scanloom-doc, and with
# SCANLOOM_PYTHON python3-scanloom. DEBFULLNAME and DEBEMAIL name the maintainer when it is configured.
cmake_host_system_information(RESULT host QUERY FQDN)
set(maintainer "The scanloom authors <root@${host}>")
if(DEFINED ENV{DEBEMAIL})
  set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "several lidars on one machine used as one")
set(CPACK_PACKAGE_CONTACT ${maintainer})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS  # whatever the umask is
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE ${CMAKE_BINARY_DIR}/changelog.Debian
  "scanloom (${PROJECT_VERSION}-1) unstable; urgency=medium\n\n  * See CHANGELOG.md of scanloom-doc.\n\n -- ${maintainer}  ${now}\n")
file(ARCHIVE_CREATE OUTPUT ${CMAKE_BINARY_DIR}/changelog.Debian.gz PATHS ${CMAKE_BINARY_DIR}/changelog.Debian
     FORMAT raw COMPRESSION GZip COMPRESSION_LEVEL 9)

macro(scanloom_package component name section depends description)
  string(TOUPPER ${component} key)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${key}_PACKAGE_DEPENDS "${depends}")
  set(CPACK_DEBIAN_${key}_DESCRIPTION "${description}")
  install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} RENAME copyright COMPONENT ${component})
  install(FILES ${CMAKE_BINARY_DIR}/changelog.Debian.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name}
          COMPONENT ${component})
endmacro()

scanloom_package(program scanloom science "libjs-three"
"Merges the packets of several spinning lidars on one machine into point clouds
whose points are in time order, at a constant rate, without phase lock, so that
algorithms for one lidar work unchanged. Localises with them, and makes maps.")
scanloom_package(plugin scanloom-mrpt-plugin science ""
"A plugin for rawlog-grabber, rawlog-edit and RawLogViewer: the sensor
CMultiLidarSensor, and point clouds with a time and a lidar for each point.")
scanloom_package(doc scanloom-doc doc ""
"Tutorial, how-to pages, parameters and studies, as Markdown.")
if(laszip_library)
  set(laszip_dev ", liblaszip-dev")
endif()
scanloom_package(dev libscanloom-dev libdevel
"libceres-dev, libcpp-httplib-dev, libeigen3-dev, libfmt-dev, liblzf-dev, liblzma-dev, libmrpt-expr-dev, libmrpt-img-dev, libmrpt-obs-dev, libbz2-dev, liblz4-dev, libpcap-dev, libsqlite3-dev, libssl-dev, libtbb-dev, libzstd-dev, nlohmann-json3-dev, pkgconf, robin-map-dev, zlib1g-dev${laszip_dev}"
"Decoding, batching, IMU preintegration, NDT registration and the estimator, as
static libraries for CMake's find_package(scanloom).")
if(SCANLOOM_PYTHON)
  find_package(Python REQUIRED COMPONENTS Interpreter)
  math(EXPR next "${Python_VERSION_MINOR} + 1")
  set(minor ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR})
  scanloom_package(python python3-scanloom python
"python3 (>= ${minor}), python3 (<< ${Python_VERSION_MAJOR}.${next}), python3-numpy"
"Python module: scans of several lidars as numpy arrays, poses of a machine with
covariance and health, registration of point clouds, evaluation of
trajectories.")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS scanloom)  # whose drivers serve live IMUs
endif()
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
file(WRITE ${CMAKE_BINARY_DIR}/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_PLUGIN_PACKAGE_CONTROL_EXTRA ${CMAKE_BINARY_DIR}/triggers)
include(CPack)
