# What `cmake --install` puts where, by component: program, plugin, dev, doc.
include(CMakePackageConfigHelpers)
set(share ${CMAKE_INSTALL_DATADIR}/scanloom)

install(TARGETS scanloom RUNTIME COMPONENT program)
install(TARGETS scanloom_program scanloom_devices LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/scanloom COMPONENT program)
if(TARGET scanloom_dds)
  install(TARGETS scanloom_dds LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/scanloom COMPONENT program)
endif()
install(DIRECTORY params DESTINATION ${share} COMPONENT program)
install(DIRECTORY libs/run/page/assets/ DESTINATION ${share}/page COMPONENT program)
install(FILES apps/scanloom/completions/scanloom.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        RENAME scanloom COMPONENT program)
install(FILES apps/scanloom/completions/_scanloom DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program)

# Where the loader finds it by its name alone: `rawlog-edit -p` and others hand the name to dlopen().
install(TARGETS scanloom_mrpt LIBRARY COMPONENT plugin)

install(DIRECTORY doc DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT doc)
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT doc)

find_program(HELP2MAN help2man)
if(HELP2MAN AND NOT CMAKE_CROSSCOMPILING)
  add_custom_command(OUTPUT ${CMAKE_BINARY_DIR}/man/scanloom.1.gz
    COMMAND ${CMAKE_SOURCE_DIR}/apps/packaging/manual.sh ${HELP2MAN} $<TARGET_FILE:scanloom> ${PROJECT_VERSION} ${CMAKE_BINARY_DIR}/man
    DEPENDS scanloom scanloom_program apps/packaging/manual.sh VERBATIM)
  add_custom_target(scanloom_manual ALL DEPENDS ${CMAKE_BINARY_DIR}/man/scanloom.1.gz)
  install(DIRECTORY ${CMAKE_BINARY_DIR}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
endif()

# The libraries that others can build on; those behind them need MRPT's maps and sensors, and are the program's own.
set(public_libraries base/core base/config base/formats input/lidar input/batching input/packets input/rawlogs
    input/bags input/ros2 input/rig estimation/imu estimation/preprocessing estimation/ndt estimation/graph estimation/slam)
foreach(folder ${public_libraries})
  get_filename_component(library ${folder} NAME)
  get_filename_component(module ${folder} DIRECTORY)
  set_target_properties(scanloom_${library} PROPERTIES EXPORT_NAME ${library})
  install(TARGETS scanloom_${library} EXPORT scanloom ARCHIVE COMPONENT dev)
  install(DIRECTORY libs/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/scanloom/${module} COMPONENT dev
          FILES_MATCHING PATTERN "*.h")
endforeach()
set(config ${CMAKE_INSTALL_LIBDIR}/cmake/scanloom)
install(EXPORT scanloom NAMESPACE scanloom:: DESTINATION ${config} FILE scanloomTargets.cmake COMPONENT dev)
configure_package_config_file(apps/packaging/scanloomConfig.cmake.in ${CMAKE_BINARY_DIR}/scanloomConfig.cmake
                              INSTALL_DESTINATION ${config})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/scanloomConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/scanloomConfig.cmake ${CMAKE_BINARY_DIR}/scanloomConfigVersion.cmake
        DESTINATION ${config} COMPONENT dev)
