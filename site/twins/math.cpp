// Stands for float functions that this C library rounds otherwise than the GNU one: computed in double, both round alike.
#include <cmath>

extern "C" {

float tanf(float x) {
    return float(tan(double(x)));
}
float sinf(float x) {
    return float(sin(double(x)));
}
float cosf(float x) {
    return float(cos(double(x)));
}
float acosf(float x) {
    return float(acos(double(x)));
}
float asinf(float x) {
    return float(asin(double(x)));
}
float atan2f(float y, float x) {
    return float(atan2(double(y), double(x)));
}

} // extern "C"
