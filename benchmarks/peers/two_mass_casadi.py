"""Wall, spring, mass, spring, mass on bare CasADi, from a cold start: final s1, s2, v1, v2."""

import casadi as ca

m, k = 1.0, (100.0, 200.0)  # kg, N/m
s1, s2, v1, v2 = ca.vertsplit(x := ca.SX.sym("x", 4))
f1, f2 = k[0] * s1, k[1] * (s2 - s1)
dae = {"x": x, "ode": ca.vertcat(v1, v2, (f2 - f1) / m, -f2 / m)}
integrator = ca.integrator("pair", "cvodes", dae, 0.0, 1.0, {"reltol": 1e-6, "abstol": 1e-8})
print(integrator(x0=[0.1, 0.0, 0.0, 0.0])["xf"].full().ravel().tolist())
