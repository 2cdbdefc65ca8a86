# Everything that is missing is installed by the scripts; what they may not install they name.
.PHONY: serve test reliability soak audit bench fuzz dist single pack pictures docs fmt clean

serve: dist
	@echo "Encoderscope is at http://localhost:8080 (Ctrl-C stops it)"
	@npx vite preview --logLevel warn

test:
	@tests/run.sh

reliability: dist
	@tests/reliability/run.sh matrix tabs unplugged
	@tests/reliability/soak.sh 300

soak: dist
	@tests/reliability/soak.sh $(or $(SECONDS),3600)

audit:
	@tests/audit.sh

bench:
	@tests/bench/run.sh $(if $(WRITE),--write)
	@tests/bench/page/run.sh $(if $(WRITE),--write)

fuzz:
	@tests/fuzz/run.sh $(or $(TARGET),decode) $(or $(SECONDS),600)

dist:
	@web/build.sh

single: dist
	@node web/single/build.js

pack:
	@web/package.sh

pictures: dist
	@tests/pictures/run.sh

docs: dist
	@docs/build.sh

fmt:
	@cargo fmt

clean:
	rm -rf dist web/pkg target node_modules
