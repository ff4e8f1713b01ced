// expect: no include guard
GNOMON_CONSTANT(third, 0.3333);
