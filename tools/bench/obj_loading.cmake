# How fast OBJ files are read, against tinyobjloader alone, and how long it takes until a mesh is ready.
add_executable(bench_obj_loading ${CMAKE_CURRENT_LIST_DIR}/obj_loading.cpp)
target_link_libraries(bench_obj_loading PRIVATE common rt::native rt::tinyobj rt::cli11)
use_steps(bench_obj_loading)
