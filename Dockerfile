FROM node:22-slim AS frontend
WORKDIR /src/frontend
COPY frontend/package.json frontend/package-lock.json ./
RUN npm ci --no-audit --no-fund
COPY frontend/ ./
RUN npm run build

FROM python:3.12-slim
WORKDIR /src
COPY requirements.lock pyproject.toml README.md ./
RUN pip install --no-cache-dir -r requirements.lock
COPY backend/ backend/
COPY projects/ projects/
COPY --from=frontend /src/frontend/dist frontend/dist
RUN pip install --no-cache-dir --no-deps -e . && useradd --create-home tappet && mkdir /data && chown tappet /data
USER tappet
ENTRYPOINT ["tappet"]
