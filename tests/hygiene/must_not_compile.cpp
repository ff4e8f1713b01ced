// Compiled with REAL set to a type that is no Real, which must fail with the library's own message, and to one that is.
#include <gnomon/numerics/select.h>

// A pack whose lanes have other digits than float and double.
struct long_pack {
    using value_type = long double;
    long_pack(long double);
};
long_pack operator+(long_pack, long_pack);
long_pack operator-(long_pack, long_pack);
long_pack operator*(long_pack, long_pack);
long_pack operator/(long_pack, long_pack);
long_pack operator-(long_pack);
bool operator<(long_pack, long_pack);

// The smallest expression template: a sum is a promise, not yet a number.
struct promise {};
struct lazy {
    lazy(float);
    lazy(promise);
};
promise operator+(lazy, lazy);
promise operator-(lazy, lazy);
promise operator*(lazy, lazy);
promise operator/(lazy, lazy);
promise operator-(lazy);
bool operator<(lazy, lazy);

REAL call(REAL x);
REAL call(REAL x) { return gnomon::saturate_or_zero<REAL>(x); }
#if defined(SECOND)
SECOND call(SECOND x);
SECOND call(SECOND x) { return gnomon::saturate_or_zero<SECOND>(x); }
#endif
