// What some projects have above everything else.
#pragma GCC optimize("fast-math")
