# Error against time of step 08, for each way to look for light and each sampler.
add_bench(bench_convergence convergence.cpp svg.cpp)
target_link_libraries(bench_convergence PRIVATE rt::inlining)
target_compile_definitions(bench_convergence PRIVATE "RT_OUT=\"${PROJECT_BINARY_DIR}/converged\"")
