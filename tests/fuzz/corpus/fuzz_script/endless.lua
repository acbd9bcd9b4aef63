local a = {} a.A = a a.initial = "A" machine(a)
