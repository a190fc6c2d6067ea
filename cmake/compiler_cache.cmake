# What ccache has compiled in one folder serves every other folder: the working tree, a clone, a bare Debian beside it. Paths below the
# source tree are made relative for that, in what ccache compares (CCACHE_BASEDIR) and in the debug information; so call a debugger from
# the top folder of the source tree.
find_program(IMD_CCACHE ccache)
if(IMD_CCACHE AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1 CCACHE_COMPILERCHECK=content
                                  ${IMD_CCACHE})
  add_compile_options(-ffile-prefix-map=${PROJECT_SOURCE_DIR}=.)
endif()
